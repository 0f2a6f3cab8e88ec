// SPDX-License-Identifier: MIT
#pragma once

#include "camera/arrays.hpp"

namespace tricue {

struct TargetDistribution {
    Vector density;  ///< (L,) of sum 1
    double peak;     ///< bins: bin i is [i, i + 1)
};

/// The target's part of a histogram of flow or disparity, and its peak, the representative velocity or disparity.
///
/// The histogram is smoothed: a bin's value is the mean, by the weights exp(-(j / smoothing)² / 2), |j| <= ceil(4 smoothing), of
/// those bins j away that there are. P_obj is its peak: the middle of its first highest stretch, and of one bin that has two
/// neighbours the top of the parabola through the three; its height is the highest value. P_+ is the minimum on the peak's right:
/// of all bins before the first rise, by more than `ripple` of the peak's height above the least so far, the least, of equal ones
/// the nearest to the peak. Beyond P_+ the density is that of the line through P_obj and P_+, down to 0; up to P_+,
/// and to the end where nothing rises, the smoothed histogram; and so on the left. Values are equal that differ by less
/// than 1e-9 of the peak: rounding makes no minima. The density is divided by its sum.
///
/// @param histogram (L,), finite, none negative, L at least 1; of zeros the density is zeros, and the peak NaN
/// @param smoothing bins, in [0, L]
/// @param ripple    in [0, 1); 0 takes every minimum, as the paper
/// @throws std::invalid_argument on another histogram, smoothing or ripple
/// Source: Okada, Shirai, Miura 1996, section 4.2 and figure 6; the ripple is ours.
TargetDistribution target_distribution(VectorRef histogram, double smoothing, double ripple);

}  // namespace tricue
