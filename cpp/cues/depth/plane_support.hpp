// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// How much of a depth image lies on a known plane: this tells whether that is still the floor.
///
/// Every step-th pixel of every step-th row counts, where measured. Heights h = n · X + d are in float32, to which the
/// tolerance t and -3 t are rounded.
///
/// @param depth float32 (H, W), meters
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @param plane float64 (4,): nx, ny, nz, d in meters, as floor_plane gives it; finite
/// @param tolerance t, meters, finite, above 0
/// @param step pixels, at least 1
/// @returns float64 (2,): share of the measured pixels with |h| <= t, and with h < -3 t; 0 where nothing was measured
/// @throws std::invalid_argument on other shapes or values
/// Source: ours.
Vector plane_support(const DepthView& depth, VectorRef camera, VectorRef plane, double tolerance, int step);

}  // namespace tricue
