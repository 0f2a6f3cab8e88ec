// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/prefiltered_rows.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::int16_t kClip = PrefilteredRows::kClip;

TRICUE_MULTIVERSION
void smooth_down(const std::uint8_t* __restrict above, const std::uint8_t* __restrict here,
                 const std::uint8_t* __restrict below, int n, std::int16_t* __restrict smooth) {
    for_overlapping_blocks<32>(n, [=](std::ptrdiff_t x) {
        smooth[x] = static_cast<std::int16_t>(above[x] + 2 * here[x] + below[x]);
    });
}

TRICUE_MULTIVERSION
void slope_across(const std::int16_t* __restrict smooth, int n, std::uint8_t* __restrict slope) {
    for_overlapping_blocks<32>(n, [=](std::ptrdiff_t x) {
        const auto rise = static_cast<std::int16_t>(smooth[x + 2] - smooth[x]);
        slope[x] = static_cast<std::uint8_t>(std::clamp<std::int16_t>(rise, -kClip, kClip) + kClip);
    });
}

/// Columns [begin, end) of three rows of an image, the one in the middle and its neighbors, which move down with it.
class ThreeRows {
public:
    ThreeRows(GrayCells& image, int begin, int end)
        : image_(image), begin_(begin), end_(end), room_(3 * width()) {}

    /// Rows y - 1, y and y + 1, or the nearest existing ones.
    std::array<const std::uint8_t*, 3> around(int y) {
        std::array<const std::uint8_t*, 3> rows{};
        for (int k = 0; k < 3; ++k)
            rows[static_cast<std::size_t>(k)] = read(std::clamp(y + k - 1, 0, image_.rows() - 1));
        return rows;
    }

private:
    std::size_t width() const { return static_cast<std::size_t>(end_ - begin_); }

    const std::uint8_t* read(int y) {
        const auto place = static_cast<std::size_t>(y % 3);
        if (known_[place] != y) {
            rows_[place] = image_.row(y, begin_, end_, room_.data() + place * width());
            known_[place] = y;
        }
        return rows_[place];
    }

    GrayCells& image_;
    int begin_, end_;
    std::vector<std::uint8_t> room_;
    std::array<int, 3> known_{-1, -1, -1};
    std::array<const std::uint8_t*, 3> rows_{};
};

}  // namespace

PrefilteredRows::PrefilteredRows(GrayCells image, const Region& region, bool sobel, int padding)
    : first_(std::clamp(region.y0, 0, image.rows() - 1)),
      last_(std::clamp(region.y1 - 1, 0, image.rows() - 1)),
      stride_(static_cast<std::size_t>(region.x1 - region.x0 + padding)),
      rows_(stride_ * static_cast<std::size_t>(last_ - first_ + 1)) {
    const int x0 = std::clamp(region.x0, 0, image.cols() - 1),
              x1 = std::clamp(region.x1, x0 + 1, image.cols());
    const int reach = sobel ? 1 : 0, begin = std::max(x0 - reach, 0),
              end = std::min(x1 + reach, image.cols());
    ThreeRows source(image, begin, end);
    std::vector<std::int16_t> smooth(sobel ? static_cast<std::size_t>(x1 - x0 + 2) : 0);
    for (int y = first_; y <= last_; ++y) {
        std::uint8_t* out = rows_.data() + stride_ * static_cast<std::size_t>(y - first_);
        std::uint8_t* inside = out + (x0 - region.x0);
        if (sobel) {
            const auto [above, here, below] = source.around(y);
            smooth_down(above, here, below, end - begin, smooth.data() + (begin - (x0 - 1)));
            if (x0 == 0) smooth[0] = smooth[1];
            if (x1 == image.cols()) smooth[smooth.size() - 1] = smooth[smooth.size() - 2];
            slope_across(smooth.data(), x1 - x0, inside);
        } else {
            const std::uint8_t* row = image.row(y, x0, x1, inside);
            if (row != inside) std::memcpy(inside, row, static_cast<std::size_t>(x1 - x0));
        }
        std::fill(out, inside, *inside);
        std::fill(inside + (x1 - x0), out + stride_, inside[x1 - x0 - 1]);
    }
}

const std::uint8_t* PrefilteredRows::row(int y) const {
    return rows_.data() + stride_ * static_cast<std::size_t>(std::clamp(y, first_, last_) - first_);
}

}  // namespace tricue
