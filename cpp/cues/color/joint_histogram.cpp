// SPDX-License-Identifier: MIT
#include "cues/color/joint_histogram.hpp"

#include <vector>

#include "color_cells.hpp"

namespace tricue {

Floats joint_histogram(const SampleView& samples, int bins) {
    const int bits = bits_of_bins(bins, "bins");
    Floats histograms = Floats::Zero(samples.ellipses, std::ptrdiff_t{1} << (3 * bits));
    if (samples.n == 0) return histograms;
    std::vector<std::int32_t> cells(static_cast<std::size_t>(samples.n));
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i) {
        color_cells(samples, i, bits, cells.data());
        float* counts = histograms.data() + i * histograms.cols();
        for (const std::int32_t cell : cells) counts[cell] += 1.0f;
        histograms.row(i) /= static_cast<float>(samples.n);
    }
    return histograms;
}

}  // namespace tricue
