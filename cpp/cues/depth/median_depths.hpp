// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// What is a target's in its box.
struct DepthGate {
    double expected;    ///< meters; NaN where it isn't known
    double max_offset;  ///< from it, meters, above 0
    double min_share;   ///< of the samples, under which nothing is measured, 0 to 1
};

/// The depths of targets in boxes: the median z of what is near the expected depth, its spread, and its share of the samples.
///
/// The square of a box's center and longer side has samples² squares; a sample is the depth of the pixel under a square's center,
/// computed in float64. Samples outside the image or not within 1 mm and 1 km are not measured. With an expected depth the samples
/// are those in the box's ellipse, and the expected depth that is given holds. Without one they are all that are measured, and
/// their median is the expected depth. Those within max_offset of it, in float32, are the target's.
///     spread = 1.4826 median |z_i - z|
///
/// A box with none of them, or with less than min_share of the samples, has NaN for all three.
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
