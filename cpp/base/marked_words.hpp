// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/simd.hpp"

namespace tricue {

constexpr std::size_t kWordBytes = sizeof(std::uint64_t);

/// The number of marks for `pixels` pixels, one byte each, rounded up to whole words.
constexpr std::size_t whole_words(int pixels) {
    return (static_cast<std::size_t>(pixels) + kWordBytes - 1) / kWordBytes * kWordBytes;
}

/// Calls body(x) for each pixel x of the words in which any pixel is marked. Where marks are rare, eight pixels are skipped at
/// once, because their marks are one number.
template <typename Body>
TRICUE_INLINE void for_marked_words(const std::vector<std::uint8_t>& marks, Body body) {
    for (std::size_t first = 0; first < marks.size(); first += kWordBytes) {
        std::uint64_t any;
        std::memcpy(&any, marks.data() + first, kWordBytes);
        if (any == 0) continue;
        for (std::size_t x = first; x < first + kWordBytes; ++x) body(x);
    }
}

}  // namespace tricue
