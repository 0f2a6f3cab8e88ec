// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/motion/detail/flow_planes.hpp"

namespace tricue {

/// Optical flow by the generalized gradient method with two filters g, h, the derivatives of a Gaussian along x and y.
///
/// Each pixel's u, v solve the two constraints (4), (g*f)_x u + (g*f)_y v = -(g*f)_t and the same for h (as printed (4) has lost
/// the minus of (3)): spatial gradients are those of the mean of both frames, temporal ones the difference current - previous.
/// So the flow is that of what is at this pixel halfway between the frames. It is best for motions up to half a sigma; of a wave
/// w = 2 pi / length it gives 2 tan(w u / 2) / w, too much the longer the motion is. pyramid_flow finds long ones.
///
/// angle is (5), |sin| of the angle between the lines that the constraints are in the u-v plane, 0 where |G|^2 or |H|^2 is
/// under 1e-6, which is rounding; contrast is (6). u and v are NaN where angle is 0, angle or contrast is under its minimum,
/// or the flow is longer than pi / sqrt(2) sigma = 2.2 sigma: that is half of the wave that second derivatives of the Gaussian pass
/// best, w = sqrt(2) / sigma, and of half a wave nobody can tell which way it went.
///
/// Filters are sampled and cut off at 3.5 sigma (gaussian_rows.hpp); beyond a frame's edge its pixels go on, so that flow nearer to
/// it is less exact.
///
/// @param previous, current gray frames of one size
/// @param sigma             of the Gaussian, 0.5 to 16 pixels
/// @param region            what is computed of it, in pixels of the frames; without it everything
/// @throws std::invalid_argument on frames without pixels or of unlike sizes, and on numbers out of range
/// Source: Okada, Shirai and Miura 1996, section 2.
FlowPlanes gradient_flow(const ImageView& previous, const ImageView& current, double sigma,
                         const FlowMinima& minima, const std::optional<Region>& region = {});

}  // namespace tricue
