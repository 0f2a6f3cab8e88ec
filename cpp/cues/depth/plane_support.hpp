// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// How much of a depth image lies on a plane that is known from before: is it still the floor?
///
/// Every step-th pixel of every step-th row counts, as far as it was measured. Heights h are height_above's, in float32, and
/// the tolerance t and -3 t are rounded to it.
///
/// @param depth     metres
/// @param camera    (4,): fx, fy above 0, cx, cy, pixels
/// @param plane     (4,): nx, ny, nz, d in metres, finite
/// @param tolerance t, metres, finite, above 0
/// @param step      pixels, at least 1
/// @returns         (2,): shares with |h| <= t, and with h < -3 t, as floor_plane's last two; 0 where nothing was measured
/// @throws std::invalid_argument on an argument that isn't what is said here
/// Source: ours.
Vector plane_support(const DepthView& depth, VectorRef camera, VectorRef plane, double tolerance, int step);

}  // namespace tricue
