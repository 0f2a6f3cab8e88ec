// SPDX-License-Identifier: MIT
#include "camera/reduce_gray.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "base/check.hpp"
#include "base/gray_cells.hpp"

namespace tricue {

GrayImage reduce_gray(const ImageView& image, int step, const std::optional<Region>& region) {
    const int most = std::min(image.rows, image.cols);
    if (step < 1 || step > most) refuse("step", "1 to the image's smaller side", step);
    GrayCells source(image, step);
    const auto [x0, y0, x1, y1] = region.value_or(Region{0, 0, source.cols(), source.rows()});
    require_region({x0, y0, x1, y1}, source.rows(), source.cols());
    GrayImage cells(source.rows(), source.cols());
    if (region) cells.setZero();
    const auto width = static_cast<std::size_t>(x1 - x0);
    for (int y = y0; y < y1 && width > 0; ++y) {
        std::uint8_t* out = cells.data() + std::ptrdiff_t{y} * source.cols() + x0;
        const std::uint8_t* row = source.row(y, x0, x1, out);
        if (row != out) std::memcpy(out, row, width);
    }
    return cells;
}

}  // namespace tricue
