// SPDX-License-Identifier: MIT
#include "cues/color/color_lookup.hpp"

#include "blocks.hpp"
#include "check.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

/// log2 of the table's side.
int side_bits(FloatsRef table) {
    for (int bits = 0; bits <= 6; ++bits)
        if (table.cols() == 1 << bits && table.rows() == 1 << (2 * bits)) return bits;
    refuse("table", "shape (B, B, B), B a power of two up to 64", "B = " + std::to_string(table.cols()));
}

TRICUE_MULTIVERSION
void look_up(const std::uint8_t* __restrict blue, const std::uint8_t* __restrict green,
             const std::uint8_t* __restrict red, std::ptrdiff_t n, const float* __restrict table, int bits,
             float* __restrict out) {
    const int shift = 8 - bits;
    in_blocks(n, [=](std::ptrdiff_t i) {
        const std::int32_t b = blue[i] >> shift, g = green[i] >> shift, r = red[i] >> shift;
        out[i] = table[(((b << bits) | g) << bits) | r];
    });
}

}  // namespace

Floats color_lookup(const SampleView& samples, FloatsRef table) {
    const int bits = side_bits(table);
    Floats values(samples.ellipses, samples.n);
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
        look_up(samples.plane(i, 0), samples.plane(i, 1), samples.plane(i, 2), samples.n, table.data(), bits,
                values.data() + i * samples.n);
    return values;
}

}  // namespace tricue
