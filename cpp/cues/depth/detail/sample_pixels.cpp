// SPDX-License-Identifier: MIT
#include "cues/depth/detail/sample_pixels.hpp"

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

}  // namespace tricue
