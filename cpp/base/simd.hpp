// SPDX-License-Identifier: MIT
// The only place that depends on what compilers and processors offer beyond C++: function versions, vector registers, intrinsics.
// Kernels use only the names below (tests/test_layout.py checks this).
#pragma once

#include <cstddef>  // any header of the C library defines __GLIBC__
#include <cstdint>
#include <cstring>
#include <utility>

/// The highest level of x86-64 that functions are compiled for: 1 (SSE2), 2 (SSE4.2), 3 (AVX2), 4 (AVX-512). All levels give the
/// same bits, which `make levels` proves. CMake's TRICUE_SIMD_LEVEL lowers it.
///
/// Versions need GCC 12 (the names of the levels) and glibc (indirect functions). The sanitizers can't run when the loader picks a
/// version, before they are set up. Elsewhere there is one version only; ARM's baseline has NEON anyway.
#ifndef TRICUE_SIMD_LEVEL
#define TRICUE_SIMD_LEVEL 4
#endif
#if defined(__GNUC__) && defined(__x86_64__) && TRICUE_SIMD_LEVEL >= 3
#define TRICUE_BYTE_SHUFFLES  // chosen at run time, without the loader, as are permutations
#endif
#if defined(TRICUE_BYTE_SHUFFLES) && TRICUE_SIMD_LEVEL >= 4
#define TRICUE_BYTE_PERMUTATIONS
#endif
#if !defined(__GNUC__) || defined(__clang__) || __GNUC__ < 12 || !defined(__x86_64__) || \
    !defined(__linux__) || !defined(__GLIBC__) || defined(TRICUE_SANITIZE)
#undef TRICUE_SIMD_LEVEL
#define TRICUE_SIMD_LEVEL 1
#endif

/// Put before the definition of a free function whose loops the compiler vectorizes: the compiler then makes the function once for
/// each level, and the loader picks one when the library is loaded. So one wheel serves old and new machines, and
/// `-march=native` is never needed.
///
/// - Only what is inlined into the function is compiled for the new instructions: mark helpers `inline` and keep them in
///   the same file. Eigen's own packets stay at the baseline: write plain loops over pointers.
/// - All versions give the same bits: -ffp-contract=off forbids fused multiply-adds, and without -ffast-math the compiler
///   may not change the order of a floating-point sum (which is why such a sum isn't vectorized; integer sums are).
/// - The function may not throw: GCC assumes that the dispatched call can't, and the program would end.
#if TRICUE_SIMD_LEVEL >= 4
#define TRICUE_MULTIVERSION \
    __attribute__((target_clones("default", "arch=x86-64-v2", "arch=x86-64-v3", "arch=x86-64-v4")))
#elif TRICUE_SIMD_LEVEL == 3
#define TRICUE_MULTIVERSION __attribute__((target_clones("default", "arch=x86-64-v2", "arch=x86-64-v3")))
#elif TRICUE_SIMD_LEVEL == 2
#define TRICUE_MULTIVERSION __attribute__((target_clones("default", "arch=x86-64-v2")))
#else
#define TRICUE_MULTIVERSION
#endif

/// Defines `void name parameters`, once for each width of registers, as `body<bytes> arguments`, bytes being 16 (SSE2, NEON), 32
/// (AVX2) or 64 (AVX-512). For functions on Pack, whose number of lanes has to fit the instructions; the rules of
/// TRICUE_MULTIVERSION hold. Parameters and arguments stand in parentheses: TRICUE_MULTIWIDTH(add, add_by, (int n), (n))
#define TRICUE_FOR_TARGET(target_, bytes, name, body, parameters, arguments) \
    __attribute__((target(target_))) void name parameters {                  \
        body<bytes> arguments;                                               \
    }
#if TRICUE_SIMD_LEVEL >= 4
#define TRICUE_MULTIWIDTH(name, body, parameters, arguments)                   \
    TRICUE_FOR_TARGET("default", 16, name, body, parameters, arguments)        \
    TRICUE_FOR_TARGET("arch=x86-64-v3", 32, name, body, parameters, arguments) \
    TRICUE_FOR_TARGET("arch=x86-64-v4", 64, name, body, parameters, arguments)
#elif TRICUE_SIMD_LEVEL == 3
#define TRICUE_MULTIWIDTH(name, body, parameters, arguments)            \
    TRICUE_FOR_TARGET("default", 16, name, body, parameters, arguments) \
    TRICUE_FOR_TARGET("arch=x86-64-v3", 32, name, body, parameters, arguments)
#else
#define TRICUE_MULTIWIDTH(name, body, parameters, arguments) \
    void name parameters {                                   \
        body<16> arguments;                                  \
    }
#endif

/// Put before a loop whose iterations read nothing that others write: GCC, which ignores __restrict on pointers from a struct or an
/// array, then vectorizes it.
#if defined(__GNUC__) && !defined(__clang__)
#define TRICUE_INDEPENDENT _Pragma("GCC ivdep")
#else
#define TRICUE_INDEPENDENT
#endif

/// Put before a helper that must be compiled for the instructions of the function that calls it.
#if defined(__GNUC__)
#define TRICUE_INLINE [[gnu::always_inline]] inline
#else
#define TRICUE_INLINE inline
#endif

namespace tricue {
namespace simd_detail {

template <typename Scalar, int kLanes>
struct Packed {
    using type [[gnu::vector_size(kLanes * sizeof(Scalar))]] = Scalar;
};

}  // namespace simd_detail

/// A few numbers that the compiler keeps in one vector register, or in as few as the machine has: the vector extensions of GCC
/// and Clang, with operators lane by lane. For loops that carry a state from step to step, which the compiler would otherwise
/// write to memory at each step. GCC mostly takes a Pack that is wider than the registers through memory, and compares it lane by
/// lane: TRICUE_MULTIWIDTH gives the width.
///
/// Packs are passed by reference: how they are passed by value depends on the instruction set.
template <typename Scalar, int kLanes>
using Pack = typename simd_detail::Packed<Scalar, kLanes>::type;

/// `from` and `to` need no alignment.
template <typename Lanes>
TRICUE_INLINE void load(const void* from, Lanes& to) {
    std::memcpy(&to, from, sizeof to);
}

template <typename Lanes>
TRICUE_INLINE void store(const Lanes& from, void* to) {
    std::memcpy(to, &from, sizeof from);
}

/// Each lane's number as another type; both have as many lanes.
template <typename From, typename To>
TRICUE_INLINE void convert(const From& from, To& to) {
    to = __builtin_convertvector(from, To);
}

/// Lane i of `to` is lane kFrom[i] of `from`.
template <int... kFrom, typename Lanes>
TRICUE_INLINE void permute(const Lanes& from, Lanes& to) {
#if defined(__GNUC__) && !defined(__clang__)
    to = __builtin_shuffle(from, decltype(from == from){kFrom...});
#else
    to = Lanes{from[kFrom]...};
#endif
}

/// The lanes of both interleaved: first those of the lower halves, then those of the upper ones.
template <typename Lanes, std::size_t... kPlace>
TRICUE_INLINE void interleave(const Lanes& one, const Lanes& two, Lanes& lower, Lanes& upper,
                              std::index_sequence<kPlace...>) {
    constexpr std::size_t kLanes = sizeof...(kPlace);
    const auto place = [](std::size_t first, std::size_t i) { return first + i / 2 + (i % 2) * kLanes; };
#if defined(__GNUC__) && !defined(__clang__)
    using LaneNumbers = decltype(one == one);
    lower = __builtin_shuffle(one, two, LaneNumbers{static_cast<int>(place(0, kPlace))...});
    upper = __builtin_shuffle(one, two, LaneNumbers{static_cast<int>(place(kLanes / 2, kPlace))...});
#else
    const auto take = [&](std::size_t k) { return k < kLanes ? one[k] : two[k - kLanes]; };
    lower = Lanes{take(place(0, kPlace))...};
    upper = Lanes{take(place(kLanes / 2, kPlace))...};
#endif
}

template <typename Lanes>
TRICUE_INLINE void interleave(const Lanes& one, const Lanes& two, Lanes& lower, Lanes& upper) {
    interleave(one, two, lower, upper, std::make_index_sequence<sizeof(Lanes) / sizeof(one[0])>());
}

/// to[i] = table[places[i]] for n places, a multiple of kTogether, one by one: faster than the gathers and the insertions into registers
/// that the compiler would choose, which the empty instruction keeps it from.
template <int kTogether, typename Number>
TRICUE_INLINE void pick(const Number* table, const std::int32_t* places, int n, Number* to) {
    for (int i = 0; i < n; i += kTogether)
        for (int k = i; k < i + kTogether; ++k) {
            Number picked = table[places[k]];
#if defined(__GNUC__)
            asm volatile("" : "+r"(picked));
#endif
            to[k] = picked;
        }
}

/// Lane i of `to` is number places[i] of both halves of a table, the lower one first. For registers of AVX-512, which have an instruction
/// for it.
TRICUE_INLINE void look_up(const Pack<float, 16>& lower, const Pack<float, 16>& upper,
                           const Pack<std::int32_t, 16>& places, Pack<float, 16>& to) {
#if defined(__GNUC__) && !defined(__clang__)
    to = __builtin_shuffle(lower, upper, places);
#else
    for (int i = 0; i < 16; ++i) to[i] = places[i] & 16 ? upper[places[i] & 15] : lower[places[i] & 15];
#endif
}

/// Sums the lanes in the same order on every machine.
TRICUE_INLINE double sum(const Pack<double, 4>& lanes) {
    return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// Which of 64 bytes aren't 0: bit i for byte i. All machines that tricue is built for are little-endian.
TRICUE_INLINE std::uint64_t nonzero_bytes(const std::uint8_t* bytes) {
    std::uint64_t bits = 0;
#if defined(__SSE2__)
    for (int i = 0; i < 64; i += 16) {
        Pack<char, 16> some;
        load(bytes + i, some);
        const Pack<char, 16> zero = some == 0;
        const auto none = static_cast<std::uint16_t>(__builtin_ia32_pmovmskb128(zero));
        bits |= std::uint64_t{static_cast<std::uint16_t>(~none)} << i;
    }
#else
    constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F, kOnes = 0x0101010101010101,
                            kGather = 0x0102040810204080;
    for (int i = 0; i < 64; i += 8) {
        std::uint64_t eight;
        load(bytes + i, eight);
        const std::uint64_t ones = ((((eight & kLow) + kLow) | eight) >> 7) & kOnes;
        bits |= (ones * kGather) >> 56 << i;
    }
#endif
    return bits;
}

/// The index of the lowest set bit; at least one must be set.
TRICUE_INLINE int lowest_bit(std::uint64_t bits) {
#if defined(__GNUC__)
    return __builtin_ctzll(bits);
#else
    int index = 0;
    while (!(bits & 1)) bits >>= 1, ++index;
    return index;
#endif
}

/// The number of set bits. Processors have an instruction for this from the second level of x86-64 on.
TRICUE_INLINE int count_bits(std::uint64_t bits) {
#if defined(__GNUC__)
    return __builtin_popcountll(bits);
#else
    int count = 0;
    for (; bits != 0; bits &= bits - 1) ++count;
    return count;
#endif
}

/// Tells the processor that a loop only waits, which leaves more to the other thread of its core.
TRICUE_INLINE void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

/// Begins to load the cache line of an address that will be read soon into the second-level cache: the first level can have only
/// a few lines in flight, and other reads would then wait, too.
///
/// The empty instruction is needed: GCC 12 considers a function that only prefetches to be without effect, and removes calls.
TRICUE_INLINE void prefetch(const void* address) {
#if defined(__GNUC__)
    __builtin_prefetch(address, 0, 2);
    asm volatile("");
#endif
}

/// The same for n bytes. A new frame isn't in the cache yet, and the rows of a region are too far apart for the hardware to
/// prefetch them.
TRICUE_INLINE void prefetch_bytes(const void* address, std::ptrdiff_t n) {
    constexpr std::ptrdiff_t kLine = 64;
    for (std::ptrdiff_t k = 0; k < n; k += kLine) prefetch(static_cast<const char*>(address) + k);
}

/// out[k] = table[indices[k]] for n indices and a table of 256 bytes. Processors with byte permutations (AVX-512 VBMI) do 64 at a
/// time, those with byte shuffles (AVX2) 32, in 16 steps; `out` must not overlap the others.
void look_up_bytes(const std::uint8_t* table, const std::uint8_t* indices, std::size_t n, std::uint8_t* out);

/// The version of the functions that runs on this machine, for users: "x86-64" to "x86-64-v4", "NEON", or "one version".
const char* instructions_in_use();

}  // namespace tricue
