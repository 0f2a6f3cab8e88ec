// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/prefiltered_rows.hpp"

#include <algorithm>
#include <cstring>

#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::int16_t kClip = PrefilteredRows::kClip;

TRICUE_MULTIVERSION
void smooth_down(const std::uint8_t* __restrict above, const std::uint8_t* __restrict here,
                 const std::uint8_t* __restrict below, int n, std::int16_t* __restrict smooth) {
    for (int x = 0; x < n; ++x) smooth[x] = static_cast<std::int16_t>(above[x] + 2 * here[x] + below[x]);
}

TRICUE_MULTIVERSION
void slope_across(const std::int16_t* __restrict smooth, int n, std::uint8_t* __restrict slope) {
    for (int x = 0; x < n; ++x) {
        const auto rise = static_cast<std::int16_t>(smooth[x + 2] - smooth[x]);
        slope[x] = static_cast<std::uint8_t>(std::clamp<std::int16_t>(rise, -kClip, kClip) + kClip);
    }
}

/// Columns [x0, x1) of one row of the image; `smooth` has room for two more.
void filter_row(const ImageView& image, int y, int x0, int x1, std::int16_t* smooth, std::uint8_t* out) {
    const int begin = std::max(x0 - 1, 0), end = std::min(x1 + 1, image.cols);
    const auto pixels = [&](int row) { return image.row(std::clamp(row, 0, image.rows - 1)) + begin; };
    std::int16_t* inner = smooth + (begin - (x0 - 1));
    smooth_down(pixels(y - 1), pixels(y), pixels(y + 1), end - begin, inner);
    if (x0 == 0) smooth[0] = smooth[1];
    if (x1 == image.cols) smooth[x1 - x0 + 1] = smooth[x1 - x0];
    slope_across(smooth, x1 - x0, out);
}

}  // namespace

PrefilteredRows::PrefilteredRows(const ImageView& image, const Region& region, bool sobel, int padding)
    : first_(std::clamp(region.y0, 0, image.rows - 1)),
      last_(std::clamp(region.y1 - 1, 0, image.rows - 1)),
      stride_(static_cast<std::size_t>(region.x1 - region.x0 + padding)),
      rows_(stride_ * static_cast<std::size_t>(last_ - first_ + 1)) {
    const int x0 = std::clamp(region.x0, 0, image.cols - 1), x1 = std::clamp(region.x1, x0 + 1, image.cols);
    std::vector<std::int16_t> smooth(sobel ? static_cast<std::size_t>(x1 - x0 + 2) : 0);
    for (int y = first_; y <= last_; ++y) {
        std::uint8_t* begin = rows_.data() + stride_ * static_cast<std::size_t>(y - first_);
        std::uint8_t* inside = begin + (x0 - region.x0);
        if (sobel)
            filter_row(image, y, x0, x1, smooth.data(), inside);
        else
            std::memcpy(inside, image.row(y) + x0, static_cast<std::size_t>(x1 - x0));
        std::fill(begin, inside, *inside);
        std::fill(inside + (x1 - x0), begin + stride_, inside[x1 - x0 - 1]);
    }
}

const std::uint8_t* PrefilteredRows::row(int y) const {
    return rows_.data() + stride_ * static_cast<std::size_t>(std::clamp(y, first_, last_) - first_);
}

}  // namespace tricue
