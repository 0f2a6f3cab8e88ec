// SPDX-License-Identifier: MIT
#include "base/simd.hpp"

#ifdef TRICUE_BYTE_PERMUTATIONS
#include <immintrin.h>
#endif

namespace tricue {
namespace {

#ifdef TRICUE_BYTE_PERMUTATIONS
/// A permutation uses 7 bits of an index; the eighth selects the half of the table.
__attribute__((target("avx512bw,avx512vl,avx512vbmi"))) void permute_bytes(const std::uint8_t* table,
                                                                           const std::uint8_t* indices,
                                                                           std::size_t n, std::uint8_t* out) {
    const __m512i quarter[] = {_mm512_loadu_si512(table), _mm512_loadu_si512(table + 64),
                               _mm512_loadu_si512(table + 128), _mm512_loadu_si512(table + 192)};
    for (std::size_t k = 0; k < n; k += 64) {
        const __mmask64 some = n - k >= 64 ? ~__mmask64{0} : (__mmask64{1} << (n - k)) - 1;
        const __m512i index = _mm512_maskz_loadu_epi8(some, indices + k);
        const __m512i low = _mm512_permutex2var_epi8(quarter[0], index, quarter[1]);
        const __m512i high = _mm512_permutex2var_epi8(quarter[2], index, quarter[3]);
        _mm512_mask_storeu_epi8(out + k, some, _mm512_mask_blend_epi8(_mm512_movepi8_mask(index), low, high));
    }
}

bool has_byte_permutations() {
    static const bool has = __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512bw");
    return has;
}
#else
bool has_byte_permutations() {
    return false;
}

void permute_bytes(const std::uint8_t*, const std::uint8_t*, std::size_t, std::uint8_t*) {}
#endif

}  // namespace

void look_up_bytes(const std::uint8_t* table, const std::uint8_t* indices, std::size_t n, std::uint8_t* out) {
    if (has_byte_permutations()) return permute_bytes(table, indices, n, out);
    for (std::size_t k = 0; k < n; ++k) out[k] = table[indices[k]];
}

const char* instructions_in_use() {
#if TRICUE_SIMD_LEVEL >= 4
    if (__builtin_cpu_supports("x86-64-v4")) return "x86-64-v4";
#endif
#if TRICUE_SIMD_LEVEL >= 3
    if (__builtin_cpu_supports("x86-64-v3")) return "x86-64-v3";
#endif
#if TRICUE_SIMD_LEVEL >= 2
    if (__builtin_cpu_supports("x86-64-v2")) return "x86-64-v2";
#endif
#if defined(__x86_64__) || defined(_M_X64)
    return "x86-64";
#elif defined(__aarch64__) || defined(_M_ARM64)
    return "NEON";
#else
    return "one version";
#endif
}

}  // namespace tricue
