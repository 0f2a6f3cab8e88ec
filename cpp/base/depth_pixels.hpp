// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"
#include "base/simd.hpp"

namespace tricue {

/// A number for every pixel: 0 or 1, or the label of what it belongs to.
using Labels = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Whether a pixel was measured. `&`, not `&&`: loops without a branch are vectorised.
TRICUE_INLINE bool has_depth(float z) {
    return (z > 0.0f) & (z <= std::numeric_limits<float>::max());
}

/// The least float that isn't below: `z >= float_at_least(s)` says of a float z what `z >= s` says, and `<` likewise.
float float_at_least(double s);

/// Back-projection, a column's and a row's share of it: the pixel (u, v) at depth z is (x[u] z, y[v] z, z), metres, camera
/// frame. Computed in float64, kept in float32.
struct Rays {
    std::vector<float> x, y;
};

/// @param camera (4,): focal lengths fx, fy above 0, principal point cx, cy; pixels, (0, 0) is the centre of the first
/// @throws std::invalid_argument unless that is what it is
Rays rays(VectorRef camera, const DepthView& depth);

/// @throws std::invalid_argument unless it is (4,): fx, fy above 0, cx, cy, finite
void require_camera(VectorRef camera);

/// @throws std::invalid_argument unless it is what depth_components gives of objects that were measured: (C, 7), finite, their
/// widths, heights and depths above 0
void require_table(StatesRef table);

/// @throws std::invalid_argument unless the mask has the depth image's shape
void require_mask(const ImageView& mask, const DepthView& depth);

}  // namespace tricue
