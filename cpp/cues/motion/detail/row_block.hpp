// SPDX-License-Identifier: MIT
#pragma once

#include "base/simd.hpp"

namespace tricue {

/// Rows are filtered a block of pixels at a time.
constexpr int kRowBlock = 32;

constexpr int whole_blocks(int n) {
    return (n + kRowBlock - 1) / kRowBlock * kRowBlock;
}

/// A block is two registers of AVX-512 or four of AVX2, so that no sum waits for the one before. The order of sums is the same on every
/// machine.
constexpr int kHalfBlock = kRowBlock / 2;
using HalfBlock = Pack<float, kHalfBlock>;

struct RowBlock {
    HalfBlock a, b;
};

TRICUE_INLINE void load(const float* from, RowBlock& to) {
    load(from, to.a);
    load(from + kHalfBlock, to.b);
}

TRICUE_INLINE void store(const RowBlock& from, float* to) {
    store(from.a, to);
    store(from.b, to + kHalfBlock);
}

TRICUE_INLINE void add(float weight, const RowBlock& block, RowBlock& sum) {
    sum.a += weight * block.a;
    sum.b += weight * block.b;
}

TRICUE_INLINE void add(float weight, const HalfBlock& block, HalfBlock& sum) {
    sum += weight * block;
}

TRICUE_INLINE void sum_and_difference(const RowBlock& left, const RowBlock& right, RowBlock& sum,
                                      RowBlock& difference) {
    sum = {right.a + left.a, right.b + left.b};
    difference = {right.a - left.a, right.b - left.b};
}

TRICUE_INLINE void sum_and_difference(const HalfBlock& left, const HalfBlock& right, HalfBlock& sum,
                                      HalfBlock& difference) {
    sum = right + left;
    difference = right - left;
}

/// How many of n pixels are filtered in whole blocks; the rest, if any, fits half a block: rows of a small region are short.
constexpr int in_row_blocks(int n) {
    return (n + kHalfBlock - 1) / kRowBlock * kRowBlock;
}

}  // namespace tricue
