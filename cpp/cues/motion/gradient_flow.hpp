// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/motion/detail/flow_planes.hpp"

namespace tricue {

/// Optical flow by the generalized gradient method with two filters g, h, the derivatives of a Gaussian along x and y.
///
/// The u, v of a pixel solve the constraints (4) of g and h (as printed, (4) lacks the minus of (3)):
///     (g*f)_x u + (g*f)_y v = -(g*f)_t,   (h*f)_x u + (h*f)_y v = -(h*f)_t
///
/// Spatial gradients are those of the mean of both frames, temporal ones the difference current - previous: so the flow is that
/// of the point that is at the pixel halfway between the frames. It is best for motions up to sigma / 2; on a wave of angular
/// frequency w it gives 2 tan(w u / 2) / w, which is too large, more so for longer motions. For longer motions see pyramid_flow.
///
/// u and v are NaN where angle is 0, angle or contrast is below its minimum, or the flow is longer than pi / sqrt(2) sigma = 2.2
/// sigma: half of the wavelength that the filters' gradients pass best, beyond which the direction is ambiguous. Filters are cut
/// off at 3.5 sigma; frames are extended by their edge pixels, so flow near the edge is less exact.
///
/// @param previous uint8 (H, W), gray, sides of 1 to 16384 pixels
/// @param current uint8 (H, W), gray, of the same size
/// @param sigma of the Gaussian, pixels, 0.5 to 16
/// @param min_angle smallest angle of valid flow, in [0, 1]
/// @param min_contrast smallest contrast of valid flow, finite, at least 0
/// @param region (x0, y0, x1, y1), pixels, inside the frame: the part that is computed; None for everything
/// @returns u float32 (h, w): flow along x, pixels per frame; NaN where not reliable
/// @returns v float32 (h, w): flow along y
/// @returns angle float32 (h, w): equation (5), |sin| of the angle between the two constraints' lines in the u-v plane, in
///     [0, 1]; 0 where |G|² or |H|² is below 1e-6, which is rounding
/// @returns contrast float32 (h, w): equation (6), (gray levels / pixel²)²
/// @throws std::invalid_argument on frames without pixels, too large or of different sizes, or numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 2.
FlowPlanes gradient_flow(const ImageView& previous, const ImageView& current, double sigma,
                         const FlowMinima& minima, const std::optional<Region>& region = {});

}  // namespace tricue
