// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/rank_likelihood.hpp"

namespace tricue {

/// The colors of a target and of its surround, and the table that follows from them.
struct ColorContrast {
    Floats target;    ///< float32 (B, B, B): the target's histogram, of sum 1 once learned
    Floats surround;  ///< float32 (B, B, B): the surround's histogram, of sum 1 once learned
    Floats table;     ///< float32 (B, B, B): P(target | color)
};

/// Samples an ellipse and its surround, updates the color histograms of both, and computes the table P(target | color) by Bayes'
/// rule with equal priors:
///     new = old + rate (seen - old),   table = target / (target + surround + rare)
///
/// All in float32; in C++ a cube is B² rows (blue, green) of B reds. `seen` is the joint_histogram of the samples.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel, 2 GB at most
/// @param ellipse float64 (4,): center x, y, semi-axes along x and y, pixels, finite
/// @param target float32 (B, B, B), B a power of two up to 64: the target's histogram so far; zeros at first, with a rate of 1
/// @param surround float32 (B, B, B): the surround's histogram so far
/// @param rate learning rate, in [0, 1]
/// @param rare above 0: the share of a cell below which it says little about either side
/// @throws std::invalid_argument on other or mismatched shapes, or a rate or rare out of range
/// Source: ours; the histograms are those of Vezhnevets, Sazonov, Andreeva 2003, section 3.1.
ColorContrast learn_contrast(const ImageView& image, VectorRef ellipse, const EllipsePattern& pattern,
                             FloatsRef target, FloatsRef surround, double rate, double rare);

}  // namespace tricue
