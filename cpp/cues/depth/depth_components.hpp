// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/bit_image.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"
#include "base/pixel_runs.hpp"

namespace tricue {

/// How a region's depths, and its pixels over its box, are counted.
struct HistogramLayout {
    double near, far;  ///< range of the histograms, meters, 0 <= near < far, finite
    int levels;        ///< levels of a histogram, 0 (none) to 4096
    int bins;          ///< equal parts of a box, across and down, whose pixels are counted, 1 to 4096
};

/// The component of each pixel, from 1; 0 if none.
using LabelImage = Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// C regions.
struct DepthComponents {
    /// float64 (C, 7): x, y, width, height of the box and area, pixels; mean depth, meters; label
    States table;
    Floats histograms;  ///< float32 (C, levels): shares of the measured pixels at each level
    Floats columns;     ///< float32 (C, bins): shares of the area, left to right
    Floats rows;        ///< float32 (C, bins): shares of the area, top to bottom
    LabelImage image;   ///< int32 (H, W): the region of each pixel, from 1; 0 if none; (0, 0) if not wanted
};

/// Connected regions (8 neighbors) of one label other than 0 in a divided depth image, the largest first, with their histograms.
///
/// Equally large regions are in the reading order of their first pixels. Pixels without a measurement belong to a region, but
/// count neither in its mean nor in its histogram; in a region without measurements the mean is NaN, and the histogram all 0.
///
/// The level of a depth z is floor((z - near) (levels / (far - near))) in float64, clamped to [0, levels - 1]. A pixel that is in
/// several bins of its box counts in each by the share of its width that is there; rows likewise. Shares are float64 quotients of
/// whole numbers, rounded to float32.
///
/// @param labels uint8 (H, W), 0 where there is no object
/// @param depth float32 (H, W), meters
/// @param min_area smallest area, pixels, at least 1; smaller regions are 0 in the image
/// @param image whether the image of regions is wanted: it takes a fifth of the time
/// @throws std::invalid_argument on labels of another shape, or parameters out of range
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A; labeling after Rosenfeld, Pfaltz 1966.
DepthComponents depth_components(const ImageView& labels, const DepthView& depth,
                                 const HistogramLayout& layout, int min_area, bool image);

/// The runs of equal labels of pixels that have one.
///
/// @param labeled which pixels have a label; of others it isn't read
/// @param changes where, of two neighbors in a row that have a label, the right one has another
/// @param single whether isolated pixels count: noise is mostly such pixels, and each would be a run and a component
PixelRuns label_runs(const BitImage& labeled, const BitImage& changes, const ImageView& labels, bool single);

/// The regions of these runs, as depth_components gives them.
DepthComponents describe_components(PixelRuns& runs, const DepthView& depth, const HistogramLayout& layout,
                                    int min_area, bool image);

}  // namespace tricue
