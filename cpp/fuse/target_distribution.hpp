// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct TargetDistribution {
    Vector density;  ///< float64 (L,), of sum 1; zeros for a histogram of zeros
    double peak;     ///< in bins, bin i being [i, i + 1); NaN for a histogram of zeros
};

/// The target's part of a histogram of flow or disparity, and its peak, the representative velocity or disparity.
///
/// The histogram is smoothed: a bin becomes the mean, with the weights exp(-(j / smoothing)² / 2), |j| <= ceil(4 smoothing), of the
/// bins j away that exist. P_obj is its peak: the middle of its first highest stretch, and for a single bin with two neighbors the
/// top of the parabola through the three; its height is that of the bin where it lies. With an expected peak P_obj is that of the
/// values times exp(-((center - expected) / spread)² / 2), divided by the factor of the nearest bin that is not empty, against
/// underflow: a higher peak far from the expected one is another object's. What follows uses the smoothed histogram as it is.
///
/// P_+ is the minimum to the right of the peak: the lowest bin, of equals the nearest to the peak, from the peak's own up to the
/// first rise by more than `min_prominence` times the peak's height above the lowest so far. Up to P_+ the density is the
/// smoothed histogram; beyond, it is the line through P_obj and P_+ down to 0, or 0 if P_+ is the peak's own bin. Without such a
/// rise it is the smoothed histogram to the end. The left side is alike. Values that differ by less than 1e-9 of the peak are
/// equal. The density is divided by its sum.
///
/// @param histogram float64 (L,), L at least 1, finite, none negative
/// @param smoothing bins, in [0, L]
/// @param min_prominence in [0, 1); 0 takes every minimum, as in the paper
/// @param expected bins, as the peak, in the range or off it; NaN for the highest peak, as in the paper
/// @param spread bins, above 0; infinity means no expectation
/// @throws std::invalid_argument on another histogram, smoothing, prominence or spread, or an infinite expected peak
/// Source: Okada, Shirai, Miura 1996, section 4.2 and figure 6; the prominence and the expectation (after section 4.1) are ours.
TargetDistribution target_distribution(VectorRef histogram, double smoothing, double min_prominence,
                                       double expected, double spread);

}  // namespace tricue
