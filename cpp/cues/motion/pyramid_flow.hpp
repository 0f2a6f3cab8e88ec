// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/motion/detail/flow_planes.hpp"

namespace tricue {

struct FlowPyramid {
    int levels = 3;         ///< 2 to 8, each half as large as the one before
    int pool = 3;           ///< radius of the window in pixels of each level, 0 to 16
    double max_step = 0.4;  ///< pixels, above 0
};

/// Optical flow from coarse to fine: gradient_flow's constraints (4), pooled over a window, on an image pyramid with warping.
///
/// At each level `previous` is warped towards `current` by the flow so far, and the constraints of all pixels of a window
/// give a step by least squares, damped by what rounding to gray levels adds to them. Between levels steps are cut to 2 pixels along
/// x and y, the median of 3x3 pixels is taken, and the flow is doubled. So the flow is that of what is at the pixel in
/// `current`: it was at (x - u, y - v) in `previous`. It finds motions up to about sigma 2^(levels - 1) pixels.
///
/// contrast is the mean of (6) over the window; angle is 2 sqrt(det) / trace of the normal equations, 0 to 1, which for a single
/// pixel with constraints of the same strength is (5). u and v are NaN where one of them is under its minimum, contrast under
/// 1e-6, or the step of the last level longer than max_step: there the coarser levels were wrong.
///
/// At every level the flow is computed of the region alone, and beyond it that of its edge goes on.
///
/// @param sigma of the filters' Gaussian in pixels of each level, 0.5 to 16
/// @throws std::invalid_argument on frames without pixels or of unlike sizes, and on numbers out of range
/// Source: Okada, Shirai and Miura 1996, section 2; pooling and warping as Lucas and Kanade 1981, Bouguet 2000.
FlowPlanes pyramid_flow(const ImageView& previous, const ImageView& current, double sigma,
                        const FlowPyramid& pyramid, const FlowMinima& minima,
                        const std::optional<Region>& region = {});

}  // namespace tricue
