// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/color/detail/color_space.hpp"

namespace tricue {

/// A model of colors that never forgets the first ones.
struct FirstColors {
    VectorRef first;  ///< float64 (L,), the first histogram
    double weight;    ///< of the first histogram in the model, 0 to 1
};

struct LearnedHistogram {
    Vector histogram;  ///< float64 (L,)
    Vector model;      ///< float64 (L,), the mixture of the first histogram with it
    Vector color;      ///< float64 (3,), the histogram's mean color, color levels, as histogram_mean gives it
};

/// A color histogram that learns from a measured one, M' = M + a (C - M), and its mixture with the first, (1 - w) M' + w F.
///
/// @param histogram float64 (L,), M, L = n_0 n_1 n_2, in the order of color_bins
/// @param measured float64 (L,), C
/// @param rate a, 0 to 1; 0 learns nothing
/// @param first float64 (L,), F
/// @param weight w, 0 to 1
/// @throws std::invalid_argument on other sizes, a rate or weight out of range, or where the result isn't finite, has a negative
///     number, or has no sum above 0
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, equation (2) and μ of equation (7); the mixture is ours.
LearnedHistogram learn_histogram(VectorRef histogram, VectorRef measured, double rate,
                                 const FirstColors& first, const ColorSpace& space);

}  // namespace tricue
