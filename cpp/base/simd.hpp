// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>  // any header of the C library defines __GLIBC__

/// Put before the definition of a free function whose loops the compiler vectorises: the compiler then makes the function
/// four times, for the baseline of x86-64 (SSE2), for v2 (SSE4.2), v3 (AVX2) and v4 (AVX-512), and the loader picks one when the
/// library is loaded. So one wheel serves old and new machines, and `-march=native` is never needed.
///
/// - Only what is inlined into the function is compiled for the new instructions: mark helpers `inline` and keep them in
///   the same file. Eigen's own packets stay at the baseline: write plain loops over pointers.
/// - All four give the same bits: -ffp-contract=off forbids fused multiply-adds, and without -ffast-math the compiler
///   may not change the order of a floating-point sum (which is why such a sum isn't vectorised; integer sums are).
/// - The function may not throw: GCC takes the dispatched call for one that can't, and the program ends.
/// - It needs GCC 12 (the names of the levels), and glibc (indirect functions). The sanitizers can't run when the
///   loader picks, before they are set up. Elsewhere it is empty; ARM's baseline has NEON anyway.
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12 && defined(__x86_64__) && \
    defined(__linux__) && defined(__GLIBC__) && !defined(TRICUE_SANITIZE)
#define TRICUE_MULTIVERSION \
    __attribute__((target_clones("default", "arch=x86-64-v2", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define TRICUE_MULTIVERSION
#endif

/// Put before one of several definitions of the same function, one for each of "default", "arch=x86-64-v3" (AVX2) and
/// "arch=x86-64-v4" (AVX-512), where each has to be written for the width of its registers (lanes.hpp); the loader picks one, and
/// what is said above holds. Where TRICUE_VERSIONS isn't defined only "default" may be there.
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12 && defined(__x86_64__) && \
    defined(__linux__) && defined(__GLIBC__) && !defined(TRICUE_SANITIZE)
#define TRICUE_VERSIONS
#define TRICUE_VERSION(target_) __attribute__((target(target_)))
#else
#define TRICUE_VERSION(target_)
#endif

/// Put before a loop that writes to nothing that it reads elsewhere in it: GCC, which doesn't believe __restrict of pointers that
/// come in a struct or an array, then vectorises it.
#if defined(__GNUC__) && !defined(__clang__)
#define TRICUE_INDEPENDENT _Pragma("GCC ivdep")
#else
#define TRICUE_INDEPENDENT
#endif
