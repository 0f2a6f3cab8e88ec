// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/simd.hpp"

namespace tricue {

/// N numbers that the compiler keeps in one vector register, or in as few as the machine has: the vector extensions of GCC and
/// Clang, for loops that carry a state from step to step, which the vectoriser would write to memory at each.
/// N has to fit the instructions in use (kLanes128 and so on): wider comparisons are done one by one.
/// They go from function to function by reference: how they are passed by value depends on the instructions.
template <int N>
struct Lanes {
    using Bytes [[gnu::vector_size(N)]] = std::uint8_t;
    using SignedBytes [[gnu::vector_size(N)]] = std::int8_t;
    using Words [[gnu::vector_size(2 * N)]] = std::uint16_t;
    using SignedWords [[gnu::vector_size(2 * N)]] = std::int16_t;
    using Floats [[gnu::vector_size(2 * N)]] = float;  ///< N / 2
};

/// How many words one register holds: everywhere (SSE2, NEON), with AVX2, with AVX-512.
constexpr int kLanes128 = 8, kLanes256 = 16, kLanes512 = 32;

template <typename Vector>
[[gnu::always_inline]] inline void read(const void* from, Vector& to) {
    std::memcpy(&to, from, sizeof to);
}

template <typename Vector>
[[gnu::always_inline]] inline void write(const Vector& from, void* to) {
    std::memcpy(to, &from, sizeof from);
}

}  // namespace tricue
