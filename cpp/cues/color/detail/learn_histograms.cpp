// SPDX-License-Identifier: MIT
#include "cues/color/detail/learn_histograms.hpp"

#include <string>
#include <utility>

#include "base/check.hpp"
#include "base/color_cells.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void divide(const std::int32_t* __restrict counts, float all, std::ptrdiff_t n, float* __restrict shares) {
    for (std::ptrdiff_t k = 0; k < n; ++k) shares[k] = static_cast<float>(counts[k]) / all;
}

TRICUE_MULTIVERSION
void blend(const float* __restrict old, float rate, std::ptrdiff_t n, float* __restrict blended) {
    for (std::ptrdiff_t k = 0; k < n; ++k) blended[k] = old[k] + rate * (blended[k] - old[k]);
}

TRICUE_MULTIVERSION
void compute_table(const float* __restrict target, const float* __restrict surround, float rare,
                   float of_rare, std::ptrdiff_t n, float* __restrict table) {
    for (std::ptrdiff_t k = 0; k < n; ++k)
        table[k] = (target[k] + of_rare) / (target[k] + surround[k] + rare);
}

}  // namespace

Floats ColorCounts::shares(Eigen::Index rows) const {
    const auto n = static_cast<Eigen::Index>(cells.size());
    Floats found(rows, n / rows);
    divide(cells.data(), pixels > 0 ? static_cast<float>(pixels) : 1.0F, n, found.data());
    return found;
}

void require_histograms(FloatsRef target, FloatsRef surround, double rate, double rare) {
    if (bits_of_cube(target, "target") != bits_of_cube(surround, "surround"))
        refuse("surround", "the target's shape", "B = " + std::to_string(surround.cols()));
    if (!(rate >= 0.0 && rate <= 1.0)) refuse("rate", "a number in [0, 1]", rate);
    if (!(rare > 0.0)) refuse("rare", "a number above 0", rare);
}

ColorContrast learn_histograms(Floats within, Floats without, FloatsRef target, FloatsRef surround,
                               double rate, double rare, double unseen) {
    const auto share = static_cast<float>(rate);
    blend(target.data(), share, within.size(), within.data());
    blend(surround.data(), share, without.size(), without.data());
    Floats table(within.rows(), within.cols());
    compute_table(within.data(), without.data(), static_cast<float>(rare), static_cast<float>(unseen * rare),
                  table.size(), table.data());
    return {std::move(within), std::move(without), std::move(table)};
}

}  // namespace tricue
