// SPDX-License-Identifier: MIT
#include "cues/color/histogram_mean.hpp"

namespace tricue {

Vector histogram_mean(VectorRef histogram, const ColorSpace& space) {
    return mean_color(histogram, require_histogram(histogram, space), space);
}

}  // namespace tricue
