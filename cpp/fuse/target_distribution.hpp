// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct TargetDistribution {
    Vector density;  ///< (L,) of sum 1
    double peak;     ///< bins: bin i is [i, i + 1)
};

/// The target's part of a histogram of flow or disparity, and its peak, the representative velocity or disparity.
///
/// The histogram is smoothed: a bin's value is the mean, by the weights exp(-(j / smoothing)² / 2), |j| <= ceil(4 smoothing), of
/// those bins j away that there are. P_obj is its peak: the middle of its first highest stretch, and of one bin that has two
/// neighbours the top of the parabola through the three; its height is the smoothed histogram's in the bin where it lies.
///
/// With an expected peak that is of the values times exp(-((centre - expected) / spread)² / 2): a target moves with nearly constant
/// velocity between two frames, and a higher peak far from it is another object's. The factors are divided by that of the nearest
/// bin that isn't empty, so that they don't all underflow: where one far from everything is expected the peak is that bin. What
/// follows is done to the smoothed histogram as it is.
///
/// P_+ is the minimum on the peak's right: of the peak's bin and all before the first rise, by more than `ripple` of the peak's
/// height above the least so far, the least, of equal ones the nearest to the peak. Beyond P_+ the density is that of the line
/// through P_obj and P_+, down to 0, and 0 where P_+ is the peak's own bin, a shoulder of a higher peak; up to P_+, and to
/// the end where nothing rises, the smoothed histogram; and so on the left. Values are equal that differ by less
/// than 1e-9 of the peak: rounding makes no minima. The density is divided by its sum.
///
/// @param histogram (L,), finite, none negative, L at least 1; of zeros the density is zeros, and the peak NaN
/// @param smoothing bins, in [0, L]
/// @param ripple    in [0, 1); 0 takes every minimum, as the paper
/// @param expected  bins, as the peak, in the range or off it; NaN for the highest peak, as in the paper
/// @param spread    bins, above 0; infinity is as no expectation
/// @throws std::invalid_argument on another histogram, smoothing, ripple or spread, or an infinite expected peak
/// Source: Okada, Shirai, Miura 1996, section 4.2 and figure 6; the ripple and the expectation (after section 4.1) are ours.
TargetDistribution target_distribution(VectorRef histogram, double smoothing, double ripple, double expected,
                                       double spread);

}  // namespace tricue
