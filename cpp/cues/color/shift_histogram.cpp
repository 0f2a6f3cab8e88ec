// SPDX-License-Identifier: MIT
#include "cues/color/shift_histogram.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"

namespace tricue {
namespace {

/// Moves by `offset` bins along the middle one of three axes, of `outer`, `bins` and `inner` cells.
Vector shift_axis(const Vector& from, Eigen::Index outer, int bins, Eigen::Index inner, double offset) {
    // A shift by twice the axis' length already moves everything to its end bin.
    const double bounded = std::clamp(offset, -2.0 * bins, 2.0 * bins), whole = std::floor(bounded);
    const double rest = bounded - whole;
    Vector to = Vector::Zero(from.size());
    for (Eigen::Index block = 0; block < outer; ++block)
        for (int bin = 0; bin < bins; ++bin) {
            const auto at = [&](int place) {
                return (block * bins + std::clamp(place, 0, bins - 1)) * inner;
            };
            const auto mass = from.segment(at(bin), inner);
            if ((mass == 0.0).all()) continue;  // most bins of a head's histogram are empty
            const int place = bin + static_cast<int>(whole);
            to.segment(at(place), inner) += (1.0 - rest) * mass;
            to.segment(at(place + 1), inner) += rest * mass;
        }
    return to;
}

}  // namespace

Vector shift_histogram(VectorRef histogram, const ColorSpace& space, VectorRef mean) {
    const double sum = require_histogram(histogram, space);
    require_size(mean, 3, "mean");
    require_finite(mean, "mean");

    const Vector offset = mean - mean_color(histogram, sum, space);
    Vector shifted = histogram;
    Eigen::Index outer = 1, inner = space.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        inner /= space.bins[axis];
        shifted = shift_axis(shifted, outer, space.bins[axis], inner,
                             offset[static_cast<Eigen::Index>(axis)] / space.width(axis));
        outer *= space.bins[axis];
    }
    return shifted;
}

}  // namespace tricue
