// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// What describes a component: its histogram has `levels` of [near, far), metres; its pixels are counted in `bins` parts of its box.
struct Signature {
    double near, far;
    int levels, bins;
};

/// Which component has a pixel, from 1; 0 if none.
using LabelImage = Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// C components, the largest first, of equal ones that whose first pixel in reading order comes first.
struct DepthComponents {
    States table;       ///< C x 7: x, y, width, height of the box, area, pixels; mean depth, metres; label
    Floats histograms;  ///< C x levels: shares of the measured pixels
    Floats columns;     ///< C x bins: shares of the area, left to right
    Floats rows;        ///< C x bins: shares of the area, top to bottom
    LabelImage image;   ///< H x W, from 1; empty where it isn't wanted
};

/// The objects of a divided depth image: connected regions (8 neighbours) of one label other than 0, with their signatures.
///
/// Pixels without a measurement belong to a region by their label, but count neither for its mean, NaN without any, nor for
/// its histogram, all 0 without any. The level of depth z is floor((z - near) (levels / (far - near))) in float64, clamped to
/// [0, levels - 1]. Pixel x of a box from x0 is in bin floor((2 (x - x0) + 1) bins / (2 width)); rows are counted alike. A
/// share is a quotient of whole numbers in float64, rounded to float32.
///
/// @param labels    (H, W) uint8, 0 where there is no object
/// @param depth     (H, W) metres
/// @param signature 0 <= near < far, finite; levels at least 0, which is no histogram, bins at least 1
/// @param min_area  smallest area, pixels, at least 1; smaller components are 0 in the image of components
/// @param image     whether that image is made: it takes a fifth of the time
/// @throws std::invalid_argument on labels of another shape, or parameters out of these ranges
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A; labelling after Rosenfeld, Pfaltz 1966.
DepthComponents depth_components(const ImageView& labels, const DepthView& depth, const Signature& signature,
                                 int min_area, bool image);

}  // namespace tricue
