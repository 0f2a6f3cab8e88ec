// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/simd.hpp"

namespace tricue {

/// A number per pixel: 0 or 1 in a mask, or the label of the region that the pixel belongs to.
using Labels = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Whether a pixel was measured. `&`, not `&&`: loops without a branch are vectorized.
TRICUE_INLINE bool has_depth(float z) {
    return (z > 0.0f) & (z <= std::numeric_limits<float>::max());
}

/// The smallest float that isn't below s. For a float z, `z >= round_up_to_float(s)` is the same as `z >= s`; likewise `<`.
float round_up_to_float(double s);

/// Viewing rays: the pixel (u, v) at depth z is the point (x[u] z, y[v] z, z), meters, camera frame. Computed in float64, stored in
/// float32.
struct Rays {
    std::vector<float> x, y;
};

/// @param camera (4,): focal lengths fx, fy above 0, principal point cx, cy; pixels, (0, 0) is the center of the first
/// @throws std::invalid_argument unless the camera is that
Rays find_rays(VectorRef camera, const DepthView& depth);

/// @throws std::invalid_argument unless it is (4,): fx, fy above 0, cx, cy, finite
void require_camera(VectorRef camera);

/// @throws std::invalid_argument unless it is a table of measured objects as depth_components returns it: (C, 7), finite, widths,
/// heights and depths above 0
void require_object_table(StatesRef table);

}  // namespace tricue
