// SPDX-License-Identifier: MIT
#include "cues/depth/above_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

struct Limits {
    float near, far, clear;
};

TRICUE_MULTIVERSION
void keep_row(const float* __restrict depth, const float* __restrict across, int n, float down, float offset,
              const Limits& limits, float* __restrict kept) {
    // Not a structured binding: lambdas can't capture these in C++17, and clang refuses it.
    const float near = limits.near, far = limits.far, clear = limits.clear;
    for_overlapping_blocks(n, [=](std::ptrdiff_t u) {
        const float z = depth[u], h = z * (across[u] + down) + offset;
        const bool inside = has_depth(z) & (z >= near) & (z < far) & (h > clear);
        kept[u] = inside ? z : std::numeric_limits<float>::quiet_NaN();
    });
}

void require_space(const Space& space) {
    require_not_negative(space.near, "near");
    if (!(space.far > space.near && std::isfinite(space.far)))
        refuse("far", "a finite number above near", space.far);
    if (!std::isfinite(space.clear)) refuse("clear", "a finite number", space.clear);
}

}  // namespace

Floats above_floor(const DepthView& depth, VectorRef camera, VectorRef plane, const Space& space) {
    auto [across, down] = find_rays(camera, depth);
    require_size(plane, 4, "plane");
    require_finite(plane, "plane");
    require_space(space);
    const Eigen::Array4f p = plane.cast<float>();
    const bool known = (plane != 0.0).any();
    if (!known)  // 0 times a slope that overflows float32 would be NaN
        for (auto* slopes : {&across, &down}) std::fill(slopes->begin(), slopes->end(), 0.0f);
    for (float& x : across) x = p[0] * x;
    const Limits limits{static_cast<float>(space.near), static_cast<float>(space.far),
                        known ? static_cast<float>(space.clear) : -std::numeric_limits<float>::infinity()};
    Floats kept(depth.rows, depth.cols);
    for (int v = 0; v < depth.rows; ++v)
        keep_row(depth.row(v), across.data(), depth.cols, p[1] * down[static_cast<std::size_t>(v)] + p[2],
                 p[3], limits, kept.data() + std::ptrdiff_t{v} * depth.cols);
    return kept;
}

}  // namespace tricue
