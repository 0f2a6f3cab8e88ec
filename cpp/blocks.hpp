// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

namespace tricue {

/// Calls body(i) for every i in [0, n), in blocks of 64, the last of which ends at n and so overlaps the one before.
///
/// Loops over bytes are vectorised 64 at a time, and what is left over is done one by one: of a row of 251 samples 59 took
/// as long as all others. `body` must therefore be fit to be called twice for the same i: out[i] = f(in[i]).
template <typename Body>
[[gnu::always_inline]] inline void in_blocks(std::ptrdiff_t n, Body body) {
    constexpr std::ptrdiff_t kBlock = 64;
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
