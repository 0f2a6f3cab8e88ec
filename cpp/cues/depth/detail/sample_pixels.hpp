// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "base/depth_view.hpp"

namespace tricue {

/// The samples along one axis that lie in the image: the first one, and the pixel of each.
struct SamplePixels {
    std::size_t first = 0;
    std::vector<int> pixels;
};

constexpr std::size_t kPrefetchSamples = 4;  ///< rows of samples that are loaded ahead

/// The pixels, of `size`, at the centers start + (i + 1/2) step of `count` samples.
SamplePixels find_sample_pixels(double start, double step, int count, int size);

/// Starts loading row i of the samples, if there is one.
void prefetch_samples(const DepthView& depth, const SamplePixels& across, const SamplePixels& down,
                      std::size_t i);

}  // namespace tricue
