// SPDX-License-Identifier: MIT
#include "cues/stereo/head_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/check.hpp"
#include "cues/stereo/detail/cell_disparities.hpp"

namespace tricue {
namespace {

/// A region of cells in pixels.
Region to_pixels(const Region& cells, int step) {
    const auto times = [&](int corner) {
        const std::int64_t pixels = std::int64_t{corner} * step;
        if (std::abs(pixels) > std::numeric_limits<int>::max() / 2)
            refuse("region", "corners within a billion pixels", std::to_string(pixels));
        return static_cast<int>(pixels);
    };
    return {times(cells.x0), times(cells.y0), times(cells.x1), times(cells.y1)};
}

/// Clears the cells outside the image, to which those inside may have spread the head's disparity.
void clear_outside(const Region& region, int rows, int cols, CellMask& coherent) {
    const auto before = [](int begin, Eigen::Index n) {
        return std::clamp<Eigen::Index>(-Eigen::Index{begin}, 0, n);
    };
    const auto after = [](int end, int size, Eigen::Index n) {
        return std::clamp<Eigen::Index>(Eigen::Index{end} - size, 0, n);
    };
    coherent.topRows(before(region.y0, coherent.rows())) = 0;
    coherent.bottomRows(after(region.y1, rows, coherent.rows())) = 0;
    coherent.leftCols(before(region.x0, coherent.cols())) = 0;
    coherent.rightCols(after(region.x1, cols, coherent.cols())) = 0;
}

}  // namespace

HeadCells head_cells(const ImageView& left, const ImageView& right, const Region& region, int step,
                     const ColorSpace& space, const std::array<double, 3>* gains, const HeadDepth& depth,
                     const DisparityRange& limits, const StereoMatching& matching) {
    const Floats disparities = cell_disparities({left, right, step}, {region, false}, limits, matching);
    HeadCells cells{color_bins(left, to_pixels(region, step), space, step, gains),
                    coherent_cells(disparities, depth.expected, depth.tolerance, depth.fill)};
    clear_outside(region, left.rows / step, left.cols / step, cells.coherent);
    return cells;
}

}  // namespace tricue
