// SPDX-License-Identifier: MIT
#include "cues/color/detail/byte_lookup.hpp"

#if defined(__GNUC__) && defined(__x86_64__)
#include <immintrin.h>
#define TRICUE_VBMI __attribute__((target("avx512bw,avx512vl,avx512vbmi")))
#endif

namespace tricue {
namespace {

using Table = std::array<std::uint8_t, 256>;

void look_up_each(const Table& table, const std::uint8_t* indices, std::size_t n, std::uint8_t* out) {
    for (std::size_t k = 0; k < n; ++k) out[k] = table[indices[k]];
}

#ifdef TRICUE_VBMI
/// A permutation takes 7 bits of an index; the eighth chooses between the halves of the table.
TRICUE_VBMI void look_up_permuting(const Table& table, const std::uint8_t* indices, std::size_t n,
                                   std::uint8_t* out) {
    const __m512i quarter[] = {_mm512_loadu_si512(table.data()), _mm512_loadu_si512(table.data() + 64),
                               _mm512_loadu_si512(table.data() + 128),
                               _mm512_loadu_si512(table.data() + 192)};
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
#endif

}  // namespace

void look_up(const Table& table, const std::uint8_t* indices, std::size_t n, std::uint8_t* out) {
#ifdef TRICUE_VBMI
    if (has_byte_permutations()) return look_up_permuting(table, indices, n, out);
#endif
    look_up_each(table, indices, n, out);
}

}  // namespace tricue
