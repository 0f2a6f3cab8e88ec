// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/plane_view.hpp"
#include "cues/color/learn_contrast.hpp"

namespace tricue {

/// Which pixels of a patch are a target's, and which its surround's.
struct LearnedPixels {
    double width, height;  ///< of the target's box, pixels, finite, not negative
    /// scale of the box, outside of which pixels are the surround's, finite, at least 1
    double min_surround_size;
    double min_target_posterior;  ///< P(target) of the target's pixels is above this, in [0, 1]
    /// P(target) of the surround's pixels in the ellipse is below this, in [0, 1]
    double max_surround_posterior;
};

/// learn_contrast of a patch with the target in its middle: one stage of the frame, in one call.
///
/// The target's pixels are those with their centers in the ellipse that fits into its box; half of a side counts as at least one
/// pixel. The surround's are those with their centers outside of the box times `min_surround_size`; if there are none, those
/// outside of the ellipse. If another cue gives more than half of the ellipse's pixels a P(target) above `min_target_posterior`,
/// only these pixels are the target's, and the ellipse's pixels with less than `max_surround_posterior` are the surround's, too.
/// A color that neither has gets 1/2:
///     table = (target + rare / 2) / (target + surround + rare)
///
/// @param patch uint8 (H, W, 3) BGR
/// @param other float32 (H, W), P(target) by another cue, or (0, 0) where there is none
/// @param target, surround, rate, rare as learn_contrast takes them
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: ours; as learn_contrast.
ColorContrast learn_patch_colors(const ImageView& patch, const PlaneView& other, const LearnedPixels& pixels,
                                 FloatsRef target, FloatsRef surround, double rate, double rare);

}  // namespace tricue
