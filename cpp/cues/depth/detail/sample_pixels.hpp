// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace tricue {

/// The samples along one axis that lie in the image: the first one, and the pixel of each.
struct SamplePixels {
    std::size_t first = 0;
    std::vector<int> pixels;
};

/// The pixels, of `size`, at the centers start + (i + 1/2) step of `count` samples.
SamplePixels find_sample_pixels(double start, double step, int count, int size);

}  // namespace tricue
