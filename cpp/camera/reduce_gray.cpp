// SPDX-License-Identifier: MIT
#include "camera/reduce_gray.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "base/check.hpp"
#include "base/gray_cells.hpp"

namespace tricue {

GrayImage reduce_gray(const ImageView& image, int step) {
    const int most = std::min(image.rows, image.cols);
    if (step < 1 || step > most) refuse("step", "1 to the image's smaller side", step);
    GrayCells source(image, step);
    GrayImage cells(source.rows(), source.cols());
    for (int y = 0; y < source.rows(); ++y) {
        std::uint8_t* out = cells.data() + std::ptrdiff_t{y} * source.cols();
        const std::uint8_t* row = source.row(y, 0, source.cols(), out);
        if (row != out) std::memcpy(out, row, static_cast<std::size_t>(source.cols()));
    }
    return cells;
}

}  // namespace tricue
