// SPDX-License-Identifier: MIT
#include "base/simd.hpp"

#ifdef TRICUE_BYTE_SHUFFLES
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
#endif

#ifdef TRICUE_BYTE_SHUFFLES
/// A shuffle uses the lower four bits of an index, and picks from a sixteenth of the table; each of the upper four halves what is left.
__attribute__((target("avx2"))) void shuffle_block(const std::uint8_t* table, const std::uint8_t* indices,
                                                   std::uint8_t* out) {
    const __m256i index = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices));
    const __m256i lower = _mm256_and_si256(index, _mm256_set1_epi8(15));
    __m256i found[16];
    for (int part = 0; part < 16; ++part) {
        const auto* sixteen = reinterpret_cast<const __m128i*>(table) + part;
        found[part] = _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(_mm_loadu_si128(sixteen)), lower);
    }
    for (int left = 8, bit = 4; left > 0; left /= 2, ++bit) {
        const __m256i is_upper = _mm256_slli_epi16(index, 7 - bit);  // in the highest bit of each byte
        for (int part = 0; part < left; ++part)
            found[part] = _mm256_blendv_epi8(found[2 * part], found[2 * part + 1], is_upper);
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), found[0]);
}

__attribute__((target("avx2"))) void shuffle_bytes(const std::uint8_t* table, const std::uint8_t* indices,
                                                   std::size_t n, std::uint8_t* out) {
    std::size_t k = 0;
    for (; k + 32 <= n; k += 32) shuffle_block(table, indices + k, out + k);
    for (; k < n; ++k) out[k] = table[indices[k]];
}
#endif

}  // namespace

void look_up_bytes(const std::uint8_t* table, const std::uint8_t* indices, std::size_t n, std::uint8_t* out) {
#ifdef TRICUE_BYTE_PERMUTATIONS
    static const bool permutes = __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512bw");
    if (permutes) return permute_bytes(table, indices, n, out);
#endif
#ifdef TRICUE_BYTE_SHUFFLES
    static const bool shuffles = __builtin_cpu_supports("avx2");
    if (shuffles) return shuffle_bytes(table, indices, n, out);
#endif
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
