// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <cstddef>

namespace tricue {

/// blended = learned + share (first - learned), n numbers each.
void blend_filters(const float* learned, const float* first, float share, std::ptrdiff_t n, float* blended);
void blend_filters(const std::complex<float>* learned, const std::complex<float>* first, float share,
                   std::ptrdiff_t n, std::complex<float>* blended);

/// Throws std::invalid_argument unless the share of the first frame's filter is in [0, 1].
void require_share_of_first(double share);

}  // namespace tricue
