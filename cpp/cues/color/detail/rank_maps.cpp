// SPDX-License-Identifier: MIT
#include "cues/color/detail/rank_maps.hpp"

#include <cstdlib>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/rank_table.hpp"

namespace tricue {
namespace {

/// The sum of |a - b| of bytes, in a form that compilers recognize.
inline std::int64_t sum_absolute_differences(const std::uint8_t* __restrict a,
                                             const std::uint8_t* __restrict b, std::size_t n) {
    int sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += std::abs(a[k] - b[k]);
    return sum;
}

template <typename Count>
inline std::int64_t sum_absolute_differences(const Count* __restrict a, const Count* __restrict b,
                                             std::size_t n) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += a[k] > b[k] ? a[k] - b[k] : b[k] - a[k];
    return sum;
}

inline void find_ranks(const RankTable<std::uint8_t>& table, const std::uint8_t* levels, std::size_t n,
                       std::uint8_t* ranks) {
    look_up_bytes(table.data(), levels, n, ranks);
}

template <typename Count>
inline void find_ranks(const RankTable<Count>& table, const std::uint8_t* levels, std::size_t n,
                       Count* ranks) {
    for (std::size_t k = 0; k < n; ++k) ranks[k] = table[levels[k]];
}

/// The distances between the samples of one ellipse and each of the M models.
template <typename Count>
TRICUE_MULTIVERSION void measure_distances(const SampleView& samples, std::ptrdiff_t ellipse,
                                           const Count* models, std::ptrdiff_t M, Count* ranks,
                                           double* distances) {
    const auto n = static_cast<std::size_t>(samples.n);
    std::array<RankTable<Count>, 3> tables;
    rank_tables(samples, ellipse, tables);
    for (std::size_t channel = 0; channel < 3; ++channel)
        find_ranks(tables[channel], samples.plane(ellipse, static_cast<int>(channel)), n,
                   ranks + channel * n);
    const auto size = static_cast<double>(n);
    for (std::ptrdiff_t m = 0; m < M; ++m) {
        const std::int64_t sum = sum_absolute_differences(ranks, models + 3 * m * samples.n, 3 * n);
        distances[m] = static_cast<double>(sum) / (3.0 * size * size);
    }
}

template <typename Count>
TRICUE_MULTIVERSION void scale_ranks(const float* ranks, std::size_t n, float twice, Count* counts) {
    for (std::size_t k = 0; k < n; ++k)
        counts[k] = static_cast<Count>(static_cast<std::int32_t>(ranks[k] * twice + 0.5f));
}

TRICUE_MULTIVERSION
void are_ranks(const float* numbers, std::size_t n, bool* all) {
    int others = 0;
    for (std::size_t k = 0; k < n; ++k) others += !(numbers[k] >= 0.0f && numbers[k] <= 1.0f);
    *all = others == 0;
}

void require_ranks(FloatsRef models) {
    bool all = true;
    are_ranks(models.data(), static_cast<std::size_t>(models.size()), &all);
    if (all) return;
    for (Eigen::Index i = 0; i < models.size(); ++i) {
        const float rank = models.data()[i];
        if (!(rank >= 0.0f && rank <= 1.0f)) refuse("models", "ranks in [0, 1]", static_cast<double>(rank));
    }
}

/// The models in units of 1/2n.
template <typename Count>
std::vector<Count> to_counts(FloatsRef models, std::ptrdiff_t n) {
    std::vector<Count> counts(static_cast<std::size_t>(models.size()));
    scale_ranks(models.data(), counts.size(), static_cast<float>(2 * n), counts.data());
    return counts;
}

}  // namespace

RankMaps::RankMaps(FloatsRef models, std::ptrdiff_t n) : size_(models.rows()) {
    if (n < 1) refuse("samples", "at least one an ellipse", "none");
    if (models.cols() != 3 * n)
        refuse("models", "3 x " + std::to_string(n) + " ranks, as many as samples",
               std::to_string(models.cols()));
    require_ranks(models);
    with_count_type(static_cast<std::size_t>(n), [&](auto count) {
        using Count = decltype(count);
        counts_ =
            Counts<Count>{to_counts<Count>(models, n), std::vector<Count>(static_cast<std::size_t>(3 * n))};
    });
}

void RankMaps::compare(const SampleView& samples, std::ptrdiff_t ellipse, double* distances) {
    std::visit(
        [&](auto& counts) {
            measure_distances(samples, ellipse, counts.models.data(), size_, counts.ranks.data(), distances);
        },
        counts_);
}

}  // namespace tricue
