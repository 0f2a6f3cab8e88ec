// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/simd.hpp"

namespace tricue {

/// Calls body(i) for every i in [0, n) in blocks of kBlock. The last block ends at n and may overlap the one before, so body may be
/// called twice for an i: it must be like out[i] = f(in[i]).
///
/// The compiler vectorizes loops over bytes 64 at a time and does the remainder one by one: in a row of 251 samples, it would take
/// as long as all other samples.
template <std::ptrdiff_t kBlock = 64, typename Body>
TRICUE_INLINE void for_overlapping_blocks(std::ptrdiff_t n, Body body) {
    if (n < kBlock) {
        for (std::ptrdiff_t i = 0; i < n; ++i) body(i);
        return;
    }
    for (std::ptrdiff_t start = 0; start < n; start += kBlock) {
        const std::ptrdiff_t first = std::min(start, n - kBlock);
        for (std::ptrdiff_t i = 0; i < kBlock; ++i) body(first + i);
    }
}

}  // namespace tricue
