// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// How much each kind of evidence counts.
struct EvidenceWeights {
    double filter, contrast;
};

/// The place with most evidence, filter_weight × the first filter's response + contrast_weight × contrast. Along each axis a
/// parabola through the greatest evidence and its neighbors moves the place by a fraction of a cell, at most a half; by 0 at the
/// border. In float32, parabolas in float64.
///
/// @param responses float32 (F, R, C) of F correlation filters, F at least 1, as correlation_response gives them
/// @param contrast float32 (R, C), as box_contrast gives it, or (0, 0) where there is none
/// @param filter_weight, contrast_weight finite
/// @returns float64 (5 + F,): cells to the right of column C // 2 and below row R // 2; in the cell of the greatest evidence, the
///     evidence, the first filter's response, and the contrast, 0 where there is none; and for each filter the greatest response
///     among the 3 x 3 cells there
/// @throws std::invalid_argument on other shapes, weights or evidence that isn't finite
/// Source: the weighted sum of Bertinetto et al. 2016 (Staple), equation (1).
Vector evidence_peak(const FloatStack& responses, FloatsRef contrast, const EvidenceWeights& weights);

}  // namespace tricue
