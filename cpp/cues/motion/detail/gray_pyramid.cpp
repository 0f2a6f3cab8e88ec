// SPDX-License-Identifier: MIT
#include "cues/motion/detail/gray_pyramid.hpp"

#include <algorithm>
#include <array>

#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void smooth_down(const std::array<const std::uint8_t*, 5>& rows, int n, std::uint16_t* __restrict out) {
    const std::uint8_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
    for (int x = 0; x < n; ++x)
        out[x] = static_cast<std::uint16_t>(a[x] + e[x] + 4 * (b[x] + d[x]) + 6 * c[x]);
}

/// Every second of `in`, which has two pixels more on both sides.
TRICUE_MULTIVERSION
void smooth_across(const std::uint16_t* __restrict in, int n, std::uint8_t* __restrict out) {
    for (int x = 0; x < n; ++x) {
        const std::uint16_t* p = in + 2 * x;
        out[x] = static_cast<std::uint8_t>((p[0] + p[4] + 4 * (p[1] + p[3]) + 6 * p[2] + 128) >> 8);
    }
}

/// Of n + 1 pixels of two rows.
TRICUE_MULTIVERSION
void pack(const std::uint8_t* __restrict upper, const std::uint8_t* __restrict lower, int n,
          std::uint32_t* __restrict quads) {
    for (int x = 0; x < n; ++x)
        quads[x] = std::uint32_t{upper[x]} | std::uint32_t{upper[x + 1]} << 8 |
                   std::uint32_t{lower[x]} << 16 | std::uint32_t{lower[x + 1]} << 24;
}

TRICUE_MULTIVERSION
void interpolate(const std::uint32_t* __restrict quads, int rows, int cols, int x0, int y,
                 const float* __restrict u, const float* __restrict v, int n, float* __restrict out) {
    const auto right = static_cast<float>(cols - 1), bottom = static_cast<float>(rows - 1);
    const auto row = static_cast<float>(y);
    for (int i = 0; i < n; ++i) {
        float x = static_cast<float>(x0 + i) - u[i], down = row - v[i];
        x = x > 0 ? x : 0;  // NaN becomes 0, too
        x = x > right ? right : x;
        down = down > 0 ? down : 0;
        down = down > bottom ? bottom : down;
        const int left = static_cast<int>(x), top = static_cast<int>(down);
        const float a = x - static_cast<float>(left), b = down - static_cast<float>(top);
        const auto quad = static_cast<std::int32_t>(quads[top * cols + left]);
        const auto p = static_cast<float>(quad & 255), q = static_cast<float>(quad >> 8 & 255);
        const auto r = static_cast<float>(quad >> 16 & 255), s = static_cast<float>(quad >> 24 & 255);
        const float upper = p + a * (q - p), lower = r + a * (s - r);
        out[i] = upper + b * (lower - upper);
    }
}

GrayImage downsampled(const ImageView& image) {
    GrayImage half{(image.rows + 1) / 2, (image.cols + 1) / 2, {}};
    half.pixels.resize(static_cast<std::size_t>(half.rows) * static_cast<std::size_t>(half.cols));
    std::vector<std::uint16_t> smooth(static_cast<std::size_t>(image.cols) + 4);
    std::array<const std::uint8_t*, 5> rows{};
    for (int y = 0; y < half.rows; ++y) {
        int at = 2 * y - 2;
        for (auto& row : rows) row = image.row(std::clamp(at++, 0, image.rows - 1));
        smooth_down(rows, image.cols, smooth.data() + 2);
        std::fill_n(smooth.begin(), 2, smooth[2]);
        std::fill_n(smooth.end() - 2, 2, smooth[smooth.size() - 3]);
        smooth_across(smooth.data(), half.cols, half.pixels.data() + std::ptrdiff_t{y} * half.cols);
    }
    return half;
}

}  // namespace

std::vector<GrayImage> coarser_levels(const ImageView& image, int levels) {
    std::vector<GrayImage> images{downsampled(image)};
    while (static_cast<int>(images.size()) < levels - 1) images.push_back(downsampled(images.back().view()));
    return images;
}

QuadImage::QuadImage(const ImageView& image)
    : rows_(image.rows),
      cols_(image.cols),
      quads_(static_cast<std::size_t>(image.rows) * static_cast<std::size_t>(image.cols)) {
    constexpr std::uint32_t kTwice = 0x0101;
    for (int y = 0; y < rows_; ++y) {
        const std::uint8_t *upper = image.row(y), *lower = image.row(std::min(y + 1, rows_ - 1));
        std::uint32_t* quads = quads_.data() + std::ptrdiff_t{y} * cols_;
        pack(upper, lower, cols_ - 1, quads);
        quads[cols_ - 1] = kTwice * upper[cols_ - 1] | (kTwice * lower[cols_ - 1]) << 16;
    }
}

void QuadImage::warped_row(int y, int x0, const float* u, const float* v, int n, float* out) const {
    interpolate(quads_.data(), rows_, cols_, x0, y, u, v, n, out);
}

}  // namespace tricue
