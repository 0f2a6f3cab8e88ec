// SPDX-License-Identifier: MIT
#include "cues/color/sample_ellipses.hpp"

#include <algorithm>
#include <vector>

#include "check.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

using Offsets = std::vector<std::int32_t>;

/// The places of one ellipse as byte offsets into the image. Clamping comes first, so truncation is the floor.
TRICUE_MULTIVERSION
void place(const float* __restrict u, const float* __restrict v, std::ptrdiff_t n, const double* ellipse,
           int cols, int rows, std::int32_t stride, std::int32_t* __restrict offsets) {
    const auto x = static_cast<float>(ellipse[0]), y = static_cast<float>(ellipse[1]);
    const auto minor = static_cast<float>(ellipse[2]), major = static_cast<float>(ellipse[3]);
    const auto right = static_cast<float>(cols - 1), bottom = static_cast<float>(rows - 1);
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const float column = std::min(std::max(x + minor * u[k], 0.0f), right);
        const float row = std::min(std::max(y + major * v[k], 0.0f), bottom);
        offsets[k] = static_cast<std::int32_t>(row) * stride + static_cast<std::int32_t>(column) * 3;
    }
}

void read(const std::uint8_t* pixels, const Offsets& offsets, std::uint8_t* __restrict samples) {
    const std::size_t n = offsets.size();
    std::uint8_t *blue = samples, *green = samples + n, *red = samples + 2 * n;
    for (std::size_t k = 0; k < n; ++k) {
        const std::uint8_t* pixel = pixels + offsets[k];
        blue[k] = pixel[0];
        green[k] = pixel[1];
        red[k] = pixel[2];
    }
}

}  // namespace

void sample_ellipses(const ImageView& image, StatesRef ellipses, StatesRef pattern, std::uint8_t* samples) {
    require_shape(ellipses, ellipses.rows(), 4, "ellipses");
    require_shape(pattern, pattern.rows(), 2, "pattern");
    if (image.rows < 1 || image.cols < 1) refuse("image", "at least one pixel", "none");
    require_finite(ellipses, "ellipses");
    require_finite(pattern, "pattern");

    const Eigen::Index n = pattern.rows();
    const Eigen::ArrayXf u = pattern.col(0).cast<float>(), v = pattern.col(1).cast<float>();
    Offsets offsets(static_cast<std::size_t>(n));
    for (Eigen::Index i = 0; i < ellipses.rows(); ++i) {
        place(u.data(), v.data(), n, ellipses.data() + 4 * i, image.cols, image.rows,
              static_cast<std::int32_t>(image.stride), offsets.data());
        read(image.data, offsets, samples + 3 * n * i);
    }
}

}  // namespace tricue
