// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/simd.hpp"

namespace tricue {

/// Calls body(i) for every i in [0, n), in blocks of 64 or so; the last ends at n and may overlap the one before.
///
/// The compiler vectorises loops over bytes 64 at a time and does what is left over one by one: in a row of
/// 251 samples that took as long as all the rest. `body` has to bear being called twice: out[i] = f(in[i]).
template <std::ptrdiff_t kBlock = 64, typename Body>
TRICUE_INLINE void in_blocks(std::ptrdiff_t n, Body body) {
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
