// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "base/arrays.hpp"
#include "base/depth_pixels.hpp"
#include "base/plane_view.hpp"
#include "base/rectangle.hpp"

namespace tricue {

/// One element of the observation vector F, (10): u, v or d.
struct Cue {
    PlaneView readings;  ///< (H, W), NaN where there is none
    VectorRef density;   ///< (bins,) of sum 1, or 0: P(reading | obj), target_distribution's
    double low, high;    ///< what the bins are of
    std::optional<VectorRef> alternative = {};  ///< (bins,): P(reading | not obj); without, 1 / bins each
};

/// Where the target may be: P(obj) is 1 in the window and falls linearly to 0 at the edge of the candidate region.
struct TargetPlace {
    Rectangle window, candidate;
};

struct TargetPixels {
    Labels mask;       ///< H x W: 1 where the posterior is at least the threshold, else 0
    Floats posterior;  ///< H x W: P(obj | F)
};

/// Which pixels belong to the target, by Bayes' rule, prior and posterior in one pass:
///     P(obj | F) = P(obj) L / (P(obj) L + A),   L = Π P(reading | obj),   A = Π P(reading | not obj)
///
/// L / A, in float32, is the product in order of density · bins, or of density / alternative up to 1e12, so that no product
/// overflows, which are rounded to float32, of the bin that the reading lies in (value_bins.hpp); 0 without
/// a reading or outside the range: a target pixel has every cue. The prior is min(a, b), a by the column and b by the row,
/// so that pixels of one prior lie on a rectangle: the least of 1 and, for each side where the window doesn't
/// reach the candidate region's edge, the distance of the pixel's centre from that edge over the window's; at least 0, in float64,
/// rounded to float32. Pixels whose centres aren't in the candidate region are 0.
///
/// @param cues      1 to 3, of one shape; alternatives are above 0 everywhere, as what the target isn't may be anything, and of a sum
///                  of at most 1: of what was seen round the target some may lie outside the range
/// @param threshold in (0, 1]
/// @throws std::invalid_argument on another number of cues, unlike shapes, a density, alternative or range that is none, corners
///                  that aren't finite, and another threshold
/// Source: Okada, Shirai, Miura 1996, sections 4.1 and 4.3, equations (10)-(12), figure 5. P(F) as printed is constant;
/// that every cue has to be there, and the alternatives, are ours.
TargetPixels target_pixels(const std::vector<Cue>& cues, const TargetPlace& place, double threshold);

}  // namespace tricue
