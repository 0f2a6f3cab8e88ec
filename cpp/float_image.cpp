// SPDX-License-Identifier: MIT
#include "float_image.hpp"

#include <algorithm>
#include <array>

#include "frame_rows.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void smooth_down(const std::array<const float*, 5>& rows, int n, float* __restrict out) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
    for (int x = 0; x < n; ++x) out[x] = 0.0625F * ((a[x] + e[x]) + 4 * (b[x] + d[x]) + 6 * c[x]);
}

/// Of `in`, two pixels more on both sides.
TRICUE_MULTIVERSION
void smooth_across(const float* __restrict in, int n, float* __restrict out) {
    for (int x = 0; x < n; ++x) {
        const float* p = in + 2 * x;
        out[x] = 0.0625F * ((p[0] + p[4]) + 4 * (p[1] + p[3]) + 6 * p[2]);
    }
}

TRICUE_MULTIVERSION
void interpolate(const float* data, int stride, float right, float bottom, float x0, float y, const float* u,
                 const float* v, int n, float* __restrict out) {
    for (int i = 0; i < n; ++i) {
        float x = x0 + static_cast<float>(i) - u[i], down = y - v[i];
        x = x < 0 ? 0 : x;
        x = x > right ? right : x;
        down = down < 0 ? 0 : down;
        down = down > bottom ? bottom : down;
        const int left = static_cast<int>(x), top = static_cast<int>(down);
        const float a = x - static_cast<float>(left), b = down - static_cast<float>(top);
        const int at = top * stride + left;
        const float upper = data[at] + a * (data[at + 1] - data[at]);
        const float lower = data[at + stride] + a * (data[at + stride + 1] - data[at + stride]);
        out[i] = upper + b * (lower - upper);
    }
}

}  // namespace

FloatImage::FloatImage(int rows, int cols)
    : rows_(rows),
      cols_(cols),
      data_((static_cast<std::size_t>(rows) + 1) * (static_cast<std::size_t>(cols) + 1)) {}

FloatImage::FloatImage(const ImageView& image) : FloatImage(image.rows, image.cols) {
    for (int y = 0; y < rows_; ++y) frame_row(image, y, 0, stride(), row(y));
    std::copy(row(rows_ - 1), row(rows_), row(rows_));
}

void FloatImage::repeat_last() {
    for (int y = 0; y < rows_; ++y) row(y)[cols_] = row(y)[cols_ - 1];
    std::copy(row(rows_ - 1), row(rows_), row(rows_));
}

FloatImage halved(const FloatImage& image) {
    FloatImage half((image.rows() + 1) / 2, (image.cols() + 1) / 2);
    std::vector<float> smooth(static_cast<std::size_t>(image.cols()) + 4);
    for (int y = 0; y < half.rows(); ++y) {
        std::array<const float*, 5> rows;
        for (int i = 0; i < 5; ++i)
            rows[static_cast<std::size_t>(i)] = image.row(std::clamp(2 * y + i - 2, 0, image.rows() - 1));
        smooth_down(rows, image.cols(), smooth.data() + 2);
        std::fill_n(smooth.begin(), 2, smooth[2]);
        std::fill_n(smooth.end() - 2, 2, smooth[smooth.size() - 3]);
        smooth_across(smooth.data(), half.cols(), half.row(y));
    }
    half.repeat_last();
    return half;
}

void image_row(const FloatImage& image, int y, int x0, int n, float* out) {
    const float* row = image.row(std::clamp(y, 0, image.rows() - 1));
    const int begin = std::clamp(-x0, 0, n), end = std::clamp(image.cols() - x0, begin, n);
    std::fill(out, out + begin, row[0]);
    std::copy(row + x0 + begin, row + x0 + end, out + begin);
    std::fill(out + end, out + n, row[image.cols() - 1]);
}

void warped_row(const FloatImage& image, int y, int x0, const float* u, const float* v, int n, float* out) {
    interpolate(image.row(0), image.stride(), static_cast<float>(image.cols() - 1),
                static_cast<float>(image.rows() - 1), static_cast<float>(x0), static_cast<float>(y), u, v, n,
                out);
}

}  // namespace tricue
