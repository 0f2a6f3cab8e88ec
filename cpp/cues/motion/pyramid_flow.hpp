// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/motion/detail/flow_planes.hpp"

namespace tricue {

struct FlowPyramid {
    int levels = 3;         ///< levels of the pyramid, 2 to 8, each half as large as the one before
    int pool = 3;           ///< radius of the window, pixels of each level, 0 to 16
    double max_step = 0.4;  ///< longest step of the last level, pixels, above 0
};

/// Optical flow from coarse to fine: the constraints (4) of gradient_flow, pooled over a window, on an image pyramid with warping.
///
/// At each level `previous` is warped towards `current` by the flow so far, and the constraints in a window give a step by least
/// squares, damped by the contrast that rounding to gray levels adds to them. Between levels steps are clamped to 2 pixels along
/// x and y, the median of 3 x 3 pixels is taken, and the flow is doubled. So the flow is that of the point at the pixel in
/// `current`, which was at (x - u, y - v) in `previous`. It finds motions up to about sigma 2^(levels - 1) pixels.
///
/// u and v are NaN where angle or contrast is below its minimum, contrast is below 1e-6, or the step of the last level is longer
/// than max_step: there the coarser levels were wrong. At every level only the region is computed; beyond it the flow at its edge
/// is repeated.
///
/// @param previous uint8 (H, W), gray, sides of 1 to 16384 pixels
/// @param current uint8 (H, W), gray, of the same size
/// @param sigma of the filters' Gaussian, pixels of each level, 0.5 to 16
/// @param min_angle smallest angle of valid flow, in [0, 1]
/// @param min_contrast smallest contrast of valid flow, finite, at least 0
/// @param region (x0, y0, x1, y1), pixels, inside the frame: the part that is computed; None for everything
/// @returns u float32 (h, w): flow along x, pixels per frame; NaN where not reliable
/// @returns v float32 (h, w): flow along y
/// @returns angle float32 (h, w): 2 sqrt(det) / trace of the normal equations, in [0, 1]; (5) for one pixel with constraints of
///     equal strength
/// @returns contrast float32 (h, w): mean of (6) over the window, (gray levels / pixel²)²
/// @throws std::invalid_argument on frames without pixels, too large or of different sizes, or numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 2; pooling and warping as in Lucas, Kanade 1981 and Bouguet 2000.
FlowPlanes pyramid_flow(const ImageView& previous, const ImageView& current, double sigma,
                        const FlowPyramid& pyramid, const FlowMinima& minima,
                        const std::optional<Region>& region = {});

}  // namespace tricue
