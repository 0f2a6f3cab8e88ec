// SPDX-License-Identifier: MIT
#include "cues/color/joint_histogram.hpp"

#include <vector>

#include "check.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void cells(const std::uint8_t* blue, const std::uint8_t* green, const std::uint8_t* red, std::ptrdiff_t n,
           int bits, std::int32_t* __restrict out) {
    const int shift = 8 - bits;
    for (std::ptrdiff_t k = 0; k < n; ++k)
        out[k] = (((blue[k] >> shift) << bits | (green[k] >> shift)) << bits) | (red[k] >> shift);
}

int bits_of(int bins) {
    for (int bits = 0; bits <= 6; ++bits)
        if (bins == 1 << bits) return bits;
    refuse("bins", "a power of two from 1 to 64", bins);
}

}  // namespace

Floats joint_histogram(const SampleView& samples, int bins) {
    const int bits = bits_of(bins);
    Floats histograms = Floats::Zero(samples.ellipses, std::ptrdiff_t{1} << (3 * bits));
    if (samples.n == 0) return histograms;
    std::vector<std::int32_t> cell(static_cast<std::size_t>(samples.n));
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i) {
        cells(samples.plane(i, 0), samples.plane(i, 1), samples.plane(i, 2), samples.n, bits, cell.data());
        float* counts = histograms.data() + i * histograms.cols();
        for (const std::int32_t each : cell) counts[each] += 1.0f;
        histograms.row(i) /= static_cast<float>(samples.n);
    }
    return histograms;
}

}  // namespace tricue
