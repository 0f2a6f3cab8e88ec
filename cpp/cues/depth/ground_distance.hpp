// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/simd.hpp"

namespace tricue {

/// Distances along the ground, in the direction in which the camera looks. An object that stands upright in front of a tilted
/// camera has one such distance, but many depths.
///     distance = z (a_x (u - cx) / fx + a_y (v - cy) / fy + a_z),  a = (e - (e · up) up) / |e - (e · up) up|,  e = (0, 0, 1)
///
/// clamped to near and the largest float32 below far; NaN where the depth is NaN. The factor of z is computed in float64 and
/// rounded to float32.
///
/// @param depth float32 (H, W), meters
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @param up float64 (3,): unit vector, camera frame, not along the view: (0, -1, 0) for a level camera
/// @param near, far limits of the distances, meters, finite, far above near
/// @returns float32 (H, W), meters
/// @throws std::invalid_argument on other shapes or values
/// Source: ours.
Floats ground_distance(const DepthView& depth, VectorRef camera, VectorRef up, double near, double far);

/// The factors of these distances: pixel (u, v) is float32(across[u] + down[v]) times as far along the ground as it is deep.
struct GroundView {
    std::vector<double> across, down;
    float near, far;  ///< limits of the distances, meters

    /// @throws std::invalid_argument as ground_distance
    GroundView(int rows, int cols, VectorRef camera, VectorRef up, double near_, double far_);
};

/// The distance of one pixel. NaN stays NaN: no comparison with it holds.
TRICUE_INLINE float along_ground(float depth, double factor, float near, float far) {
    const float along = depth * static_cast<float>(factor), least = along < near ? near : along;
    return least > far ? far : least;
}

}  // namespace tricue
