// SPDX-License-Identifier: MIT
#include "cues/color/rank_distance.hpp"

#include <cmath>

#include "check.hpp"
#include "rank_table.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

/// The sum of |a - b| in a fixed order of 16 lanes, which every instruction set can follow.
inline float difference(const float* __restrict a, const float* __restrict b, std::size_t n) {
    float lanes[16] = {};
    std::size_t k = 0;
    for (; k + 16 <= n; k += 16)
        for (std::size_t lane = 0; lane < 16; ++lane) lanes[lane] += std::abs(a[k + lane] - b[k + lane]);
    for (std::size_t lane = 0; k + lane < n; ++lane) lanes[lane] += std::abs(a[k + lane] - b[k + lane]);
    float sum = 0.0f;
    for (const float lane : lanes) sum += lane;
    return sum;
}

/// Adds one channel's differences to each model's sum.
TRICUE_MULTIVERSION
void compare_channel(const std::uint8_t* samples, std::size_t n, const float* model, std::size_t next_model,
                     std::size_t models, float* __restrict ranks, float* __restrict sums) {
    RankTable table;
    rank_table(samples, n, table);
    const auto twice = static_cast<float>(2 * n);
    for (std::size_t k = 0; k < n; ++k) ranks[k] = static_cast<float>(table[samples[k]]) / twice;
    for (std::size_t m = 0; m < models; ++m) sums[m] += difference(ranks, model + m * next_model, n);
}

}  // namespace

Floats rank_distance(const SampleView& samples, FloatsRef models) {
    if (samples.n < 1) refuse("samples", "at least one an ellipse", "none");
    const auto n = static_cast<std::size_t>(samples.n);
    if (models.cols() != 3 * samples.n)
        refuse("models", "3 x " + std::to_string(n) + " ranks, as many as samples",
               std::to_string(models.cols()));

    Floats distances = Floats::Zero(samples.ellipses, models.rows());
    Eigen::ArrayXf ranks(samples.n);
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
        for (int channel = 0; channel < 3; ++channel)
            compare_channel(samples.plane(i, channel), n, models.data() + channel * samples.n, 3 * n,
                            static_cast<std::size_t>(models.rows()), ranks.data(),
                            distances.data() + i * models.rows());
    return distances * (2.0f / static_cast<float>(3 * n));
}

}  // namespace tricue
