// SPDX-License-Identifier: MIT
#include "cues/color/cell_colors.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace tricue {

CellColors cell_colors(const ImageView& image, int step) {
    if (step < 1 || step > 1024) refuse("step", "1 to 1024", step);
    const auto count = [&](int size) { return (std::max(size - step / 2, 0) + step - 1) / step; };
    const int rows = count(image.rows), cols = count(image.cols);
    CellColors cells{{rows, 3 * cols}, {0.0, 0.0, 0.0}};
    std::array<std::uint64_t, 3> sums{0, 0, 0};
    std::uint8_t* out = cells.colors.data();
    for (int i = 0; i < rows; ++i) {
        std::array<std::uint32_t, 3> sum{0, 0, 0};  // of a row: of up to 2^24 pixels
        const std::uint8_t* pixel = image.row(step * i + step / 2) + 3 * (step / 2);
        for (int j = 0; j < cols; ++j, pixel += 3 * step, out += 3)
            for (std::size_t c = 0; c < 3; ++c) sum[c] += out[c] = pixel[c];
        for (std::size_t c = 0; c < 3; ++c) sums[c] += sum[c];
    }
    if (rows > 0 && cols > 0) {
        const double share = 1.0 / (static_cast<double>(rows) * cols);
        for (std::size_t c = 0; c < 3; ++c) cells.mean[c] = static_cast<double>(sums[c]) * share;
    }
    return cells;
}

}  // namespace tricue
