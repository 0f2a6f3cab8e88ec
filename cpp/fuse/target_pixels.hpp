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
    PlaneView values;   ///< (H, W), NaN where there is none
    VectorRef density;  ///< (bins,) of sum 1, or 0: P(value | obj), target_distribution's
    double low, high;   ///< range of the bins
    std::optional<VectorRef> alternative = {};  ///< (bins,): P(value | not obj); without, 1 / bins each
};

/// Where the target may be: P(obj) is 1 in the window and falls linearly to 0 at the edge of the candidate region.
struct TargetPrior {
    Rectangle window;     ///< (x0, y0, x1, y1), where the prior is 1, pixels, finite
    Rectangle candidate;  ///< (x0, y0, x1, y1), outside of which the prior is 0, pixels, finite
};

struct TargetPixels {
    Labels mask;       ///< uint8 (H, W): 1 where the posterior is at least the threshold, else 0
    Floats posterior;  ///< float32 (H, W): P(obj | F)
};

/// Which pixels belong to the target, by Bayes' rule, prior and posterior in one pass:
///     P(obj | F) = P(obj) L / (P(obj) L + A),   L = Π P(value | obj),   A = Π P(value | not obj)
///
/// L / A is, in float32, the product of each cue's ratio at the bin of its value: density times bins, or density / alternative,
/// at most 1e12, rounded to float32. It is 0 without a value or outside the range: a target pixel needs every cue. Bins are
/// those of weighted_histogram.
///
/// The prior P(obj) is 1 in the window and falls linearly to 0 at the edge of the candidate region: min(a, b, 1), at least 0,
/// where a (by column) and b (by row) are the distance of the pixel's center from that edge divided by the window's, on each side
/// where the window does not reach the edge; in float64, rounded to float32. Pixels whose centers are not in the candidate region
/// are 0.
///
/// @param planes float32 (H, W), one to three: values of u, v or d, the vector F of (10), NaN where there is none
/// @param densities float64 (bins,) for each plane: P(value | obj), of sum 1, or all 0, as target_distribution gives it
/// @param ranges (low, high) for each plane: range of its bins, finite, low < high
/// @param threshold smallest posterior of a target pixel, in (0, 1]
/// @param alternatives float64 (bins,) for each plane: P(value | not obj), above 0, of a sum of at most 1, as values may lie
///     outside the range; None for 1 / bins each
/// @throws std::invalid_argument on another number of cues, different shapes, an invalid density, alternative, range or
///     threshold, or corners that are not finite
/// Source: Okada, Shirai, Miura 1996, sections 4.1 and 4.3, equations (10)-(12), figure 5. P(F) as printed is constant; that
/// every cue is needed, and the alternatives, are ours.
TargetPixels target_pixels(const std::vector<Cue>& cues, const TargetPrior& prior, double threshold);

}  // namespace tricue
