// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/simd.hpp"

namespace tricue {

/// Rows are filtered a block of pixels at a time: one register of AVX-512, two of AVX2, four of SSE2. The order of sums is the same on
/// every machine.
constexpr int kRowBlock = 16;

/// The pixels of a block that fit a register of so many bytes. A Pack of a whole block would go through memory at each step where
/// registers are smaller: such kernels have TRICUE_MULTIWIDTH.
template <int kBytes>
constexpr int kRowLanes = kBytes / int{sizeof(float)};
template <int kBytes>
using RowLanes = Pack<float, kRowLanes<kBytes>>;

/// Rows that one step filters before the next step begins. The next step reads at other places than those just stored, so it
/// would have to wait for these stores; and a call takes as long as a short row.
constexpr int kRowBatch = 8;

constexpr int whole_blocks(int n) {
    return (n + kRowBlock - 1) / kRowBlock * kRowBlock;
}

/// In steps: there is no instruction for conversions to more than twice the width, so the compiler would convert lane by lane.
template <typename Lanes>
TRICUE_INLINE void load_bytes(const std::uint8_t* from, Lanes& to) {
    constexpr int kLanes = sizeof(Lanes) / sizeof(float);
    Pack<std::uint8_t, kLanes> bytes;
    Pack<std::uint16_t, kLanes> words;
    Pack<std::int32_t, kLanes> numbers;
    load(from, bytes);
    convert(bytes, words);
    convert(words, numbers);
    convert(numbers, to);
}

template <typename Lanes>
TRICUE_INLINE void add(float weight, const Lanes& pixels, Lanes& sum) {
    sum += weight * pixels;
}

template <typename Lanes>
TRICUE_INLINE void sum_and_difference(const Lanes& left, const Lanes& right, Lanes& sum, Lanes& difference) {
    sum = right + left;
    difference = right - left;
}

}  // namespace tricue
