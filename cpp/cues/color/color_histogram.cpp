// SPDX-License-Identifier: MIT
#include "cues/color/color_histogram.hpp"

#include <algorithm>
#include <array>

#include "base/check.hpp"

namespace tricue {
namespace {

/// Counts levels >> shift. Four tables, so that equal neighbors don't wait for each other's store.
void count(const std::uint8_t* levels, std::ptrdiff_t n, int shift,
           std::array<std::array<std::uint32_t, 256>, 4>& tables) {
    std::ptrdiff_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (std::size_t k = 0; k < 4; ++k)
            ++tables[k][static_cast<std::size_t>(levels[i + static_cast<int>(k)] >> shift)];
    for (; i < n; ++i) ++tables[0][static_cast<std::size_t>(levels[i] >> shift)];
}

}  // namespace

Floats color_histogram(const SampleView& samples, int bins) {
    if (bins < 1 || bins > 256 || 256 % bins != 0) refuse("bins", "a divisor of 256", bins);
    if (samples.n == 0) refuse("samples", "at least one for each ellipse", "none");

    int shift = 8;
    while (1 << (8 - shift) < bins) --shift;
    Floats histograms(samples.ellipses, 3 * bins);
    const auto total = static_cast<double>(samples.n);
    float* out = histograms.data();
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
        for (int channel = 0; channel < 3; ++channel) {
            std::array<std::array<std::uint32_t, 256>, 4> tables;
            for (auto& table : tables) std::fill_n(table.begin(), bins, 0U);
            count(samples.plane(i, channel), samples.n, shift, tables);
            for (std::size_t bin = 0; bin < static_cast<std::size_t>(bins); ++bin)
                *out++ = static_cast<float>(
                    (tables[0][bin] + tables[1][bin] + tables[2][bin] + tables[3][bin]) / total);
        }
    return histograms;
}

}  // namespace tricue
