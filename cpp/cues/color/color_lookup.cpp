// SPDX-License-Identifier: MIT
#include "cues/color/color_lookup.hpp"

#include <vector>

#include "base/color_cells.hpp"

namespace tricue {

Floats color_lookup(const SampleView& samples, FloatsRef table) {
    const int bits = bits_of_cube(table, "table");
    Floats values(samples.ellipses, samples.n);
    std::vector<std::int32_t> cells(static_cast<std::size_t>(samples.n));
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i) {
        color_cells(samples, i, bits, cells.data());
        float* out = values.data() + i * samples.n;
        // Not multiversioned: single loads are faster than gathers on processors with the Downfall mitigation.
        for (const std::int32_t cell : cells) *out++ = table.data()[cell];
    }
    return values;
}

}  // namespace tricue
