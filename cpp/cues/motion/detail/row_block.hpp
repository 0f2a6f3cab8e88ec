// SPDX-License-Identifier: MIT
#pragma once

#include "base/lanes.hpp"

namespace tricue {

/// Rows are filtered a block of pixels at a time.
constexpr int kRowBlock = 32;

constexpr int whole_blocks(int n) {
    return (n + kRowBlock - 1) / kRowBlock * kRowBlock;
}

/// A block is two registers of AVX-512 or four of AVX2, so that no sum waits for the one before. Sums have one order, whatever the machine.
constexpr int kHalfBlock = kRowBlock / 2;
using HalfBlock [[gnu::vector_size(4 * kHalfBlock)]] = float;

struct RowBlock {
    HalfBlock a, b;
};

[[gnu::always_inline]] inline void load(const float* from, RowBlock& to) {
    read(from, to.a);
    read(from + kHalfBlock, to.b);
}

[[gnu::always_inline]] inline void store(const RowBlock& from, float* to) {
    write(from.a, to);
    write(from.b, to + kHalfBlock);
}

[[gnu::always_inline]] inline void add(float weight, const RowBlock& block, RowBlock& sum) {
    sum.a += weight * block.a;
    sum.b += weight * block.b;
}

}  // namespace tricue
