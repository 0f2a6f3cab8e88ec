// SPDX-License-Identifier: MIT
#include "cues/depth/detail/read_grid.hpp"

#include <cmath>

#include "base/check.hpp"
#include "cues/depth/detail/sample_pixels.hpp"

namespace tricue {
Floats read_grid(const DepthView& depth, const SampleGrid& grid) {
    const SamplePixels across = find_sample_pixels(grid.x0, grid.step, grid.columns, depth.cols),
                       down = find_sample_pixels(grid.y0, grid.step, grid.rows, depth.rows);
    Floats depths = Floats::Zero(grid.rows, grid.columns);
    for (std::size_t i = 0; i < kPrefetchSamples; ++i) prefetch_samples(depth, across, down, i);
    for (std::size_t i = 0; i < down.pixels.size(); ++i) {
        prefetch_samples(depth, across, down, i + kPrefetchSamples);
        const float* row = depth.row(down.pixels[i]);
        float* to = depths.data() + (down.first + i) * static_cast<std::size_t>(grid.columns) + across.first;
        for (const int x : across.pixels) *to++ = row[x];
    }
    return depths;
}

void require_grid(const SampleGrid& grid) {
    if (!std::isfinite(grid.x0)) refuse("x0", "a finite number", grid.x0);
    if (!std::isfinite(grid.y0)) refuse("y0", "a finite number", grid.y0);
    require_positive(grid.step, "step");
    require_count(grid.rows, 1, kMaxGridSide, "rows");
    require_count(grid.columns, 1, kMaxGridSide, "columns");
}

}  // namespace tricue
