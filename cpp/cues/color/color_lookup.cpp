// SPDX-License-Identifier: MIT
#include "cues/color/color_lookup.hpp"

#include <vector>

#include "check.hpp"
#include "color_cells.hpp"

namespace tricue {
namespace {

/// log2 of the table's side.
int side_bits(FloatsRef table) {
    for (int bits = 0; bits <= 6; ++bits)
        if (table.cols() == 1 << bits && table.rows() == 1 << (2 * bits)) return bits;
    refuse("table", "shape (B, B, B), B a power of two up to 64", "B = " + std::to_string(table.cols()));
}

}  // namespace

Floats color_lookup(const SampleView& samples, FloatsRef table) {
    const int bits = side_bits(table);
    Floats values(samples.ellipses, samples.n);
    std::vector<std::int32_t> cells(static_cast<std::size_t>(samples.n));
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i) {
        color_cells(samples, i, bits, cells.data());
        float* out = values.data() + i * samples.n;
        // Not multiversioned: one load after the other is quicker than the gathers of processors that had to be mended.
        for (const std::int32_t cell : cells) *out++ = table.data()[cell];
    }
    return values;
}

}  // namespace tricue
