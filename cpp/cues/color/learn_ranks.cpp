// SPDX-License-Identifier: MIT
#include "cues/color/learn_ranks.hpp"

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void blend(const float* __restrict seen, float rate, std::ptrdiff_t n, float* __restrict learned) {
    for (std::ptrdiff_t k = 0; k < n; ++k) learned[k] += rate * (seen[k] - learned[k]);
}

}  // namespace

Floats learn_ranks(FloatsRef models, FloatsRef ranks, double rate) {
    if (models.rows() < 1) refuse("models", "at least one rank map", "none");
    if (ranks.size() != models.cols())
        refuse("ranks", "as many as in a map, " + std::to_string(models.cols()),
               std::to_string(ranks.size()));
    if (!(rate >= 0.0 && rate <= 1.0)) refuse("rate", "a number in [0, 1]", rate);
    Floats learned = models;
    blend(ranks.data(), static_cast<float>(rate), models.cols(), learned.data());
    return learned;
}

}  // namespace tricue
