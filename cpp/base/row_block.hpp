// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/simd.hpp"

namespace tricue {

/// Rows are filtered a block of pixels at a time: a register of AVX-512 or two of AVX2. The order of sums is the same on every machine.
constexpr int kRowBlock = 16;
using RowBlock = Pack<float, kRowBlock>;

/// Rows that one step filters before the next step begins. The next step reads at other places than those just stored, so it
/// would have to wait for these stores; and a call takes as long as a short row.
constexpr int kRowBatch = 8;

constexpr int whole_blocks(int n) {
    return (n + kRowBlock - 1) / kRowBlock * kRowBlock;
}

/// In steps: there is no instruction for conversions to more than twice the width, so the compiler would convert lane by lane.
TRICUE_INLINE void load_bytes(const std::uint8_t* from, RowBlock& to) {
    Pack<std::uint8_t, kRowBlock> bytes;
    Pack<std::uint16_t, kRowBlock> words;
    Pack<std::int32_t, kRowBlock> numbers;
    load(from, bytes);
    convert(bytes, words);
    convert(words, numbers);
    convert(numbers, to);
}

TRICUE_INLINE void add(float weight, const RowBlock& block, RowBlock& sum) {
    sum += weight * block;
}

TRICUE_INLINE void sum_and_difference(const RowBlock& left, const RowBlock& right, RowBlock& sum,
                                      RowBlock& difference) {
    sum = right + left;
    difference = right - left;
}

}  // namespace tricue
