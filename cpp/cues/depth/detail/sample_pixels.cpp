// SPDX-License-Identifier: MIT
#include "cues/depth/detail/sample_pixels.hpp"

#include "base/simd.hpp"

namespace tricue {

SamplePixels find_sample_pixels(double start, double step, int count, int size) {
    SamplePixels axis;
    axis.pixels.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double place = start + (i + 0.5) * step;
        if (place >= 0.0 && place < size)
            axis.pixels.push_back(static_cast<int>(place));
        else if (place < 0.0)
            ++axis.first;
    }
    return axis;
}

void prefetch_samples(const DepthView& depth, const SamplePixels& across, const SamplePixels& down,
                      std::size_t i) {
    if (i >= down.pixels.size() || across.pixels.empty()) return;
    const int first = across.pixels.front(), count = across.pixels.back() + 1 - first;
    const float* row = depth.row(down.pixels[i]);
    if (count < 16 * static_cast<int>(across.pixels.size()))
        prefetch_bytes(row + first, std::ptrdiff_t{4} * count);
    else  // samples are farther apart than cache lines
        for (const int x : across.pixels) prefetch(row + x);
}

}  // namespace tricue
