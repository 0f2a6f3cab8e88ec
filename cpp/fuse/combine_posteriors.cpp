// SPDX-License-Identifier: MIT
#include "fuse/combine_posteriors.hpp"

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr float kMinSum = 1e-9F;  // so that contradictory posteriors, 0 and 1, give a finite result

TRICUE_MULTIVERSION
void combine_row(const float* __restrict first, const float* __restrict second, int n,
                 float* __restrict combined) {
    for (int i = 0; i < n; ++i) {
        const float target = first[i] * second[i], rest = (1.0F - first[i]) * (1.0F - second[i]);
        const float sum = rest + target;
        combined[i] = target / (sum > kMinSum ? sum : kMinSum);
    }
}

}  // namespace

Floats combine_posteriors(const PlaneView& first, const PlaneView& second) {
    require_same_shape(second, first, "second");
    Floats combined(first.rows, first.cols);
    for (int i = 0; i < first.rows; ++i)
        combine_row(first.row(i), second.row(i), first.cols, combined.row(i).data());
    return combined;
}

}  // namespace tricue
