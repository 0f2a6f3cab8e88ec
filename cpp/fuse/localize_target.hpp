// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/plane_view.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// The appearance of a target.
struct TargetAppearance {
    /// complex64 (F, 19, R, C // 2 + 1), F at least 1, of its place: the first one localizes it, then others
    FilterStack filters;
    /// float32 (B, B, B), P(target | color) as color_posterior takes it, or (0, 0, 0) to ignore colors
    FloatsRef table;
    /// float64 (B³,), B a power of two up to 64: square roots of the joint histogram with which colors are compared
    VectorRef roots;
};

/// How a target is searched for in a patch.
struct TargetSearch {
    double width, height;                   ///< of the target's box, patch pixels, finite, above 0
    double surround_size, surround_weight;  ///< as box_contrast takes them
    double filter_weight,
        contrast_weight;  ///< as evidence_peak takes them; without any posterior there is no contrast
    double inner;         ///< share of the box's sides whose colors are compared, finite, above 0
};

/// The place in a patch with most evidence for a target, and the measurements there.
struct LocalizedTarget {
    /// float64 (7 + F,): evidence_peak, the first filter's peak sharpness, and the colors' similarity
    Vector found;
    Floats responses;  ///< float32 (F, R, C) of the filters; in C++ one below the other
};

/// Finds a target in a patch around its last place: one stage of the frame, in one call. It is hog_color_cells,
/// correlation_response, color_posterior, combine_posteriors, box_contrast, evidence_peak and joint_histogram, one after the
/// other.
///
/// The peak's sharpness is the number of standard deviations of the first response by which its greatest number near the place is
/// above its mean (the peak-to-sidelobe ratio of Bolme et al. 2010, with all cells). Colors are those of the pixels under the
/// inner part of the target's box there: rounded to whole pixels, halves to even, and clipped to the patch, at least one pixel
/// each way. Their similarity is the Bhattacharyya coefficient. Sums of both are in float64.
///
/// @param patch uint8 (2R, 2C, 3) BGR
/// @param taper float32 (R, C)
/// @param other float32 (2R, 2C), P(target) of the pixels by another cue, or (0, 0) where there is none
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: Danelljan et al. 2014 (DSST); Bertinetto et al. 2016 (Staple); Bolme et al. 2010 (MOSSE).
LocalizedTarget localize_target(const ImageView& patch, FloatsRef taper, const TargetAppearance& appearance,
                                const PlaneView& other, const TargetSearch& search);

}  // namespace tricue
