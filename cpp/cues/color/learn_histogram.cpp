// SPDX-License-Identifier: MIT
#include "cues/color/learn_histogram.hpp"

#include <utility>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// The shares in which the histograms are mixed.
struct Shares {
    double rate, weight;
};

TRICUE_MULTIVERSION
void mix(const double* __restrict histogram, const double* __restrict measured,
         const double* __restrict first, Eigen::Index n, const Shares& shares, double* __restrict learned,
         double* __restrict model) {
    const double rate = shares.rate, weight = shares.weight, rest = 1.0 - shares.weight;
    for (Eigen::Index i = 0; i < n; ++i) {
        learned[i] = histogram[i] + rate * (measured[i] - histogram[i]);
        model[i] = rest * learned[i] + weight * first[i];
    }
}

void require_share_of(double share, const char* name) {
    if (!(share >= 0.0 && share <= 1.0)) refuse(name, "0 to 1", share);
}

}  // namespace

LearnedHistogram learn_histogram(VectorRef histogram, VectorRef measured, double rate,
                                 const FirstColors& first, const ColorSpace& space) {
    require_space(space);
    require_size(histogram, space.size(), "histogram");
    require_size(measured, space.size(), "measured");
    require_share_of(rate, "rate");
    require_size(first.first, space.size(), "first");
    require_share_of(first.weight, "weight");

    const Eigen::Index size = histogram.size();
    Vector learned(size), model(size);
    mix(histogram.data(), measured.data(), first.first.data(), size, {rate, first.weight}, learned.data(),
        model.data());
    Vector color = mean_color(learned, require_histogram(learned, space), space);
    return {std::move(learned), std::move(model), std::move(color)};
}

}  // namespace tricue
