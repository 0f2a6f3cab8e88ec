// SPDX-License-Identifier: MIT
#include "fuse/detail/blend_filters.hpp"

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void blend(const float* __restrict learned, const float* __restrict first, float share, std::ptrdiff_t n,
           float* __restrict blended) {
    for (std::ptrdiff_t i = 0; i < n; ++i) blended[i] = learned[i] + share * (first[i] - learned[i]);
}

}  // namespace

void blend_filters(const float* learned, const float* first, float share, std::ptrdiff_t n, float* blended) {
    blend(learned, first, share, n, blended);
}

void blend_filters(const std::complex<float>* learned, const std::complex<float>* first, float share,
                   std::ptrdiff_t n, std::complex<float>* blended) {
    blend(reinterpret_cast<const float*>(learned), reinterpret_cast<const float*>(first), share, 2 * n,
          reinterpret_cast<float*>(blended));
}

void require_share_of_first(double share) {
    if (!(share >= 0.0 && share <= 1.0)) refuse("first_weight", "a number in [0, 1]", share);
}

}  // namespace tricue
