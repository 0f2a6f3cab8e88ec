// SPDX-License-Identifier: MIT
#include "cues/color/rank_distance.hpp"

#include <vector>

#include "check.hpp"
#include "rank_table.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

using Sums = Eigen::Array<std::int64_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The sum of |a - b|; of bytes and 16 bits it fits into 32 bits, which lets the compiler use its instructions for that.
template <typename Count>
inline std::int64_t difference(const Count* __restrict a, const Count* __restrict b, std::size_t n) {
    using Sum = std::conditional_t<sizeof(Count) <= 2, std::uint32_t, std::int64_t>;
    Sum sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += static_cast<Sum>(a[k] > b[k] ? a[k] - b[k] : b[k] - a[k]);
    return static_cast<std::int64_t>(sum);
}

/// Adds the differences between the samples of one ellipse and each of the models (M x 3n) to the M sums.
template <typename Count>
TRICUE_MULTIVERSION void compare(const SampleView& samples, std::ptrdiff_t ellipse, const Count* models,
                                 std::ptrdiff_t M, Count* ranks, std::int64_t* sums) {
    const auto n = static_cast<std::size_t>(samples.n);
    RankTable<Count> table;
    for (int channel = 0; channel < 3; ++channel) {
        const std::uint8_t* plane = samples.plane(ellipse, channel);
        rank_table(plane, n, table);
        for (std::size_t k = 0; k < n; ++k) ranks[k] = table[plane[k]];
        for (std::ptrdiff_t m = 0; m < M; ++m)
            sums[m] += difference(ranks, models + (3 * m + channel) * samples.n, n);
    }
}

/// The models in units of 1/2n.
template <typename Count>
std::vector<Count> rounded(FloatsRef models, std::size_t n) {
    std::vector<Count> counts;
    counts.reserve(static_cast<std::size_t>(models.size()));
    const auto twice = static_cast<float>(2 * n);
    for (Eigen::Index i = 0; i < models.size(); ++i) {
        const float rank = models.data()[i];
        if (!(rank >= 0.0f && rank <= 1.0f)) refuse("models", "ranks in [0, 1]", static_cast<double>(rank));
        counts.push_back(static_cast<Count>(rank * twice + 0.5f));
    }
    return counts;
}

}  // namespace

States rank_distance(const SampleView& samples, FloatsRef models) {
    if (samples.n < 1) refuse("samples", "at least one an ellipse", "none");
    const auto n = static_cast<std::size_t>(samples.n);
    if (models.cols() != 3 * samples.n)
        refuse("models", "3 x " + std::to_string(n) + " ranks, as many as samples",
               std::to_string(models.cols()));

    Sums sums = Sums::Zero(samples.ellipses, models.rows());
    with_count_for(n, [&](auto count) {
        const auto expected = rounded<decltype(count)>(models, n);
        std::vector<decltype(count)> ranks(n);
        for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
            compare(samples, i, expected.data(), models.rows(), ranks.data(),
                    sums.data() + i * models.rows());
    });
    const auto size = static_cast<double>(n);
    return sums.cast<double>() / (3.0 * size * size);
}

}  // namespace tricue
