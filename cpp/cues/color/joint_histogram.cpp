// SPDX-License-Identifier: MIT
#include "cues/color/joint_histogram.hpp"

#include <vector>

#include "base/color_cells.hpp"

namespace tricue {

Floats joint_histogram(const SampleView& samples, int bins) {
    const int bits = bits_of_bins(bins, "bins");
    Floats histograms = Floats::Zero(samples.ellipses, std::ptrdiff_t{1} << (3 * bits));
    if (samples.n == 0) return histograms;
    const auto n = static_cast<float>(samples.n);
    std::vector<std::int32_t> cells(static_cast<std::size_t>(samples.n));
    std::vector<std::int32_t> counts(static_cast<std::size_t>(histograms.cols()));
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i) {
        color_cells(samples, i, bits, cells.data());
        float* shares = histograms.data() + i * histograms.cols();
        // Most cells stay empty, so only those of the samples are divided, some more than once.
        for (const std::int32_t cell : cells) ++counts[static_cast<std::size_t>(cell)];
        for (const std::int32_t cell : cells)
            shares[cell] = static_cast<float>(counts[static_cast<std::size_t>(cell)]) / n;
        for (const std::int32_t cell : cells) counts[static_cast<std::size_t>(cell)] = 0;
    }
    return histograms;
}

}  // namespace tricue
