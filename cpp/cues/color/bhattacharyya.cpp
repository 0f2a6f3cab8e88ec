// SPDX-License-Identifier: MIT
#include "cues/color/bhattacharyya.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
bool all_nonnegative(const float* values, Eigen::Index n) {
    int invalid = 0;
    for (Eigen::Index i = 0; i < n; ++i)
        invalid += !(values[i] >= 0.0F && values[i] <= std::numeric_limits<float>::max());
    return invalid == 0;
}

void require_shares(FloatsRef values, const char* name) {
    if (!all_nonnegative(values.data(), values.size()))
        refuse(name, "finite numbers, none negative", "others");
}

void require_arguments(FloatsRef histograms, FloatsRef model, int groups) {
    const auto width = model.cols();
    if (histograms.cols() != width)
        refuse("model", std::to_string(histograms.cols()) + " bins, as in histograms",
               static_cast<double>(width));
    if (groups < 1 || width % groups != 0) refuse("groups", "a divisor of " + std::to_string(width), groups);
    require_shares(histograms, "histograms");
    require_shares(model, "model");
}

/// sum_k sqrt(p_k q_k) in eight partial sums: a fixed order that vectorizes.
TRICUE_MULTIVERSION
double affinity(const float* __restrict p, const float* __restrict q, Eigen::Index n) {
    double partial[8] = {};
    Eigen::Index i = 0;
    for (; i + 8 <= n; i += 8)
        for (Eigen::Index k = 0; k < 8; ++k)
            partial[k] += std::sqrt(static_cast<double>(p[i + k]) * static_cast<double>(q[i + k]));
    double sum = 0.0;
    for (; i < n; ++i) sum += std::sqrt(static_cast<double>(p[i]) * static_cast<double>(q[i]));
    for (const double part : partial) sum += part;
    return sum;
}

}  // namespace

Vector bhattacharyya(FloatsRef histograms, FloatsRef model, int groups) {
    require_arguments(histograms, model, groups);
    Vector distances(histograms.rows());
    for (Eigen::Index i = 0; i < distances.size(); ++i) {
        const double similarity = affinity(histograms.row(i).data(), model.data(), model.cols()) / groups;
        distances[i] = std::sqrt(std::max(0.0, 1.0 - similarity));
    }
    return distances;
}

}  // namespace tricue
