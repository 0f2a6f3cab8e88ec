// SPDX-License-Identifier: MIT
#include "cues/depth/plane_support.hpp"

#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/depth_rows.hpp"

namespace tricue {
namespace {

struct Count {
    int measured = 0, within = 0, below = 0;
};

struct Band {
    float within, below;
};

TRICUE_MULTIVERSION
Count count_row(const float* __restrict depth, const float* __restrict across, int n, float down,
                float offset, const Band& band) {
    int measured = 0, within = 0, below = 0;
    for (int u = 0; u < n; ++u) {
        const float z = depth[u], h = z * (across[u] + down) + offset;
        const bool counts = has_depth(z);
        measured += counts;
        within += counts & (std::abs(h) <= band.within);
        below += counts & (h < band.below);
    }
    return {measured, within, below};
}

}  // namespace

Vector plane_support(const DepthView& depth, VectorRef camera, VectorRef plane, double tolerance, int step) {
    const Rays lens = find_rays(camera, depth);
    require_size(plane, 4, "plane");
    require_finite(plane, "plane");
    require_positive(tolerance, "tolerance");
    if (step < 1) refuse("step", "at least 1", step);

    const Eigen::Array4f p = plane.cast<float>();
    const Band band{static_cast<float>(tolerance), static_cast<float>(-3.0 * tolerance)};
    std::vector<float> across, row;
    for (int u = 0; u < depth.cols; u += step) across.push_back(p[0] * lens.x[static_cast<std::size_t>(u)]);
    row.resize(across.size());
    Count all;
    for (int v = 0; v < depth.rows; v += step) {
        thin_row(depth.row(v), static_cast<std::ptrdiff_t>(row.size()), step, row.data());
        const Count count = count_row(row.data(), across.data(), static_cast<int>(row.size()),
                                      p[1] * lens.y[static_cast<std::size_t>(v)] + p[2], p[3], band);
        all.measured += count.measured;
        all.within += count.within;
        all.below += count.below;
    }
    Vector support = Vector::Zero(2);
    if (all.measured > 0)
        support << static_cast<double>(all.within) / all.measured,
            static_cast<double>(all.below) / all.measured;
    return support;
}

}  // namespace tricue
