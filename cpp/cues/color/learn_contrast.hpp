// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Joint histograms of a target's colors and of those round it, each of sum 1 once it has been learnt, and what follows of them by
/// Bayes' rule with equal priors: P(target | color). Cubes (B², B): rows (blue, green), columns red.
struct ColorContrast {
    Floats target, surround, table;
};

/// Blends the colors seen now into both histograms, old + rate (new - old), and makes the table anew:
/// target / (target + surround + rare). All in float32.
///
/// @param inside, around    samples of one ellipse each, as joint_histogram counts them
/// @param target, surround  what was known; zeros at the start, with a rate of 1
/// @param rate              in [0, 1]
/// @param rare              above 0: a cell's share under which it says little about either side
/// @throws std::invalid_argument on cubes of other or unlike sizes, not one ellipse, or a rate or rare out of range
/// Source: ours; the histograms are those of Vezhnevets, Sazonov, Andreeva 2003, section 3.1.
ColorContrast learn_contrast(const SampleView& inside, const SampleView& around, FloatsRef target,
                             FloatsRef surround, double rate, double rare);

}  // namespace tricue
