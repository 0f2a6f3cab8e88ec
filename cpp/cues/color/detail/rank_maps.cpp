// SPDX-License-Identifier: MIT
#include "cues/color/detail/rank_maps.hpp"

#include <array>
#include <cmath>
#include <type_traits>

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

inline void find_ranks(const RankTable<std::uint8_t>& table, const std::uint8_t* places, std::size_t n,
                       std::uint8_t* ranks) {
    look_up_bytes(table.data(), places, n, ranks);
}

template <typename Count>
inline void find_ranks(const RankTable<Count>& table, const std::uint8_t* places, std::size_t n,
                       Count* ranks) {
    for (std::size_t k = 0; k < n; ++k) ranks[k] = table[places[k]];
}

/// The models, and buffers for the samples of the ellipses that are compared at once.
template <typename Count>
struct Buffers {
    const Count* models;
    std::ptrdiff_t M;
    std::uint8_t* places;
    Count* ranks;
};

/// The distances between the samples of kEllipses consecutive ellipses and each of the M models.
template <std::size_t kEllipses, typename Count>
TRICUE_INLINE void measure_distances(const std::uint8_t* planes, std::size_t n, const Buffers<Count>& buffers,
                                     double* distances) {
    rank_places(planes, 3 * n * kEllipses, buffers.places);
    alignas(64) std::array<RankTable<Count>, 3 * kEllipses> tables;
    rank_tables(buffers.places, n, tables);
    for (std::size_t plane = 0; plane < tables.size(); ++plane)
        find_ranks(tables[plane], buffers.places + plane * n, n, buffers.ranks + plane * n);
    const auto size = static_cast<double>(n);
    for (std::size_t ellipse = 0; ellipse < kEllipses; ++ellipse)
        for (std::ptrdiff_t m = 0; m < buffers.M; ++m) {
            const std::int64_t sum = sum_absolute_differences(
                buffers.ranks + 3 * n * ellipse, buffers.models + 3 * n * static_cast<std::size_t>(m), 3 * n);
            *distances++ = static_cast<double>(sum) / (3.0 * size * size);
        }
}

template <typename Count>
TRICUE_MULTIVERSION void measure_all_distances(const SampleView& samples, const Buffers<Count>& buffers,
                                               double* distances) {
    std::ptrdiff_t i = 0;
    for (; i + 2 <= samples.ellipses; i += 2)
        measure_distances<2>(samples.plane(i, 0), static_cast<std::size_t>(samples.n), buffers,
                             distances + i * buffers.M);
    if (i < samples.ellipses)
        measure_distances<1>(samples.plane(i, 0), static_cast<std::size_t>(samples.n), buffers,
                             distances + i * buffers.M);
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

void require_rank_maps(FloatsRef models, std::ptrdiff_t n) {
    if (n < 1) refuse("samples", "at least one an ellipse", "none");
    if (models.cols() != 3 * n)
        refuse("models", "3 x " + std::to_string(n) + " ranks, as many as samples",
               std::to_string(models.cols()));
    require_ranks(models);
}

RankMaps::RankMaps(FloatsRef models, std::ptrdiff_t n) : size_(models.rows()) {
    require_rank_maps(models, n);
    with_count_type(static_cast<std::size_t>(n), [&](auto count) {
        using Count = decltype(count);
        counts_ =
            Counts<Count>{to_counts<Count>(models, n), std::vector<Count>(static_cast<std::size_t>(6 * n))};
    });
    places_.resize(static_cast<std::size_t>(6 * n));
}

void RankMaps::compare(const SampleView& samples, double* distances) {
    std::visit(
        [&](auto& counts) {
            using Count = typename std::decay_t<decltype(counts)>::Number;
            const Buffers<Count> buffers{counts.models.data(), size_, places_.data(), counts.ranks.data()};
            measure_all_distances(samples, buffers, distances);
        },
        counts_);
}

}  // namespace tricue
