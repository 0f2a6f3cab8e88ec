// SPDX-License-Identifier: MIT
#include "cues/color/sample_ellipses.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "blocks.hpp"
#include "check.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

using Offsets = std::vector<std::int32_t>;
using Words = std::vector<std::uint32_t>;

/// The bytes of an image, at least four of them: an image of one pixel is copied.
struct Whole {
    explicit Whole(const ImageView& image) : pixels(image.data) {
        const std::ptrdiff_t bytes = (image.rows - 1) * image.stride + 3 * std::ptrdiff_t{image.cols};
        last = static_cast<std::int32_t>(std::max<std::ptrdiff_t>(bytes - 4, 0));
        if (bytes >= 4) return;
        std::memcpy(one, image.data, 3);
        pixels = one;
    }
    Whole(const Whole&) = delete;
    Whole& operator=(const Whole&) = delete;

    const std::uint8_t* pixels;
    std::int32_t last;  ///< the offset of the last word
    std::uint8_t one[4] = {};
};

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

/// Each pixel as one word of four bytes, the fourth of the next pixel. The image's last pixel has no next: it is read one byte
/// early, and shifted. Not multiversioned: gathers are slower than loads on processors that had to be mended.
void read(const std::uint8_t* pixels, std::int32_t last, const Offsets& offsets, Words& words) {
    for (std::size_t k = 0; k < offsets.size(); ++k) {
        const std::int32_t offset = std::min(offsets[k], last);
        std::memcpy(&words[k], pixels + offset, sizeof words[k]);
        words[k] >>= 8 * (offsets[k] - offset);
    }
}

TRICUE_MULTIVERSION
void split(const std::uint32_t* __restrict words, std::ptrdiff_t n, std::uint8_t* __restrict blue,
           std::uint8_t* __restrict green, std::uint8_t* __restrict red) {
    in_blocks(n, [=](std::ptrdiff_t k) {
        blue[k] = static_cast<std::uint8_t>(words[k]);
        green[k] = static_cast<std::uint8_t>(words[k] >> 8);
        red[k] = static_cast<std::uint8_t>(words[k] >> 16);
    });
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
    Words words(offsets.size());
    const Whole whole(image);
    for (Eigen::Index i = 0; i < ellipses.rows(); ++i) {
        place(u.data(), v.data(), n, ellipses.data() + 4 * i, image.cols, image.rows,
              static_cast<std::int32_t>(image.stride), offsets.data());
        read(whole.pixels, whole.last, offsets, words);
        std::uint8_t* out = samples + 3 * n * i;
        split(words.data(), n, out, out + n, out + 2 * n);
    }
}

}  // namespace tricue
