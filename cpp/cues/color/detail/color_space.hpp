// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "base/arrays.hpp"

namespace tricue {

/// The axes (B - G, G - R, B + G + R) of Birchfield 1998, each cut into equal bins: bin (i, j, k) has index (i n_1 + j) n_2 + k.
///
/// The two chroma axes range from -chroma to chroma; values beyond go to the end bins. Over the whole range, ±255, nearly all
/// pixels of a real picture would fall into a few bins around 0. The third axis ranges from 0 to 765.
struct ColorSpace {
    std::array<int, 3> bins;  ///< (n_0, n_1, n_2), bins of each axis, 1 to 256 each, at most 65535 in all
    int chroma;  ///< the first two axes span [-chroma, chroma), color levels, 1 to 255; values beyond go to the end bins

    std::ptrdiff_t size() const { return std::ptrdiff_t{bins[0]} * bins[1] * bins[2]; }

    /// Whole levels along an axis: 2 chroma, or 766.
    int levels(std::size_t axis) const { return axis < 2 ? 2 * chroma : 766; }

    /// How many levels a bin has.
    double width(std::size_t axis) const { return static_cast<double>(levels(axis)) / bins[axis]; }

    /// The mean of the levels in an axis' first bin, color units.
    double first(std::size_t axis) const {
        return (width(axis) - 1.0) / 2.0 - (axis < 2 ? static_cast<double>(chroma) : 0.0);
    }
};

/// Throws std::invalid_argument unless there are 1 to 256 bins an axis, at most 65535 in all, and chroma is in [1, 255].
void require_space(const ColorSpace& space);

/// Returns the sum of a histogram over the space. Throws unless it is (size(),), finite, nonnegative, with a sum above 0.
double require_histogram(VectorRef histogram, const ColorSpace& space);

/// The mean (3,) of such a histogram with this sum; every bin counts at the mean of its levels.
Vector mean_color(VectorRef histogram, double sum, const ColorSpace& space);

}  // namespace tricue
