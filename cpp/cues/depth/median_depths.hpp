// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Which depths in a target's box are the target's.
struct DepthGate {
    double expected;    ///< meters; NaN where it isn't known
    double max_offset;  ///< from it, meters, above 0
    double min_share;   ///< of the samples, under which nothing is measured, 0 to 1
};

/// The depths of targets in boxes: the median z of the depths near the expected one, their spread, and their share of the
/// samples.
///
/// A square around a box's center, with its longer side, is divided into samples² squares; a sample is the depth of the pixel
/// under such a square's center, computed in float64. Samples outside the image or not between 1 mm and 1 km are not measured.
/// With an expected depth, the samples are those in the box's ellipse, measured or not. Without one, they are the measured ones of
/// the whole square, and their median is the expected depth. The target's are those less than max_offset from it, in float32.
///     spread = 1.4826 median |z_i - z|
///
/// Without any of these, or with less than min_share of the samples, all three are NaN.
///
/// @param depth float32 (H, W), meters; may be empty
/// @param boxes float64 (N, 4): x and y of the center, width, height, pixels; finite, sizes above 0
/// @param samples on a side of the square, 1 to 1024
/// @param expected meters; NaN where it isn't known
/// @param max_offset meters from the expected depth, finite, above 0
/// @param min_share of the samples, 0 to 1
/// @returns float64 (N, 3): z and spread, meters, and share
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: ours; the median absolute deviation as a robust standard deviation, as Rousseeuw and Croux 1993, (1.2).
States median_depths(const DepthView& depth, StatesRef boxes, int samples, const DepthGate& gate);

}  // namespace tricue
