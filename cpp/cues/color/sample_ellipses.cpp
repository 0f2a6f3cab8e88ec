// SPDX-License-Identifier: MIT
#include "cues/color/sample_ellipses.hpp"

#include "base/check.hpp"
#include "cues/color/detail/ellipse_sampler.hpp"

namespace tricue {

void sample_ellipses(const ImageView& image, StatesRef ellipses, StatesRef pattern, std::uint8_t* samples) {
    require_shape(ellipses, ellipses.rows(), 4, "ellipses");
    EllipseSampler sampler(image, pattern, "pattern");
    require_finite(ellipses, "ellipses");
    sampler.read(ellipses.data(), ellipses.rows(), samples);
}

}  // namespace tricue
