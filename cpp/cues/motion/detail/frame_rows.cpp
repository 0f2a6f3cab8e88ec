// SPDX-License-Identifier: MIT
#include "cues/motion/detail/frame_rows.hpp"

#include <algorithm>
#include <cstddef>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// n is a whole number of blocks.
template <int kBytes>
TRICUE_INLINE void compare_by(const std::uint8_t* __restrict before, const std::uint8_t* __restrict now,
                              int n, float* __restrict mean, float* __restrict change) {
    for (int x = 0; x < n; x += kRowLanes<kBytes>) {
        RowLanes<kBytes> first, second;
        load_bytes(before + x, first);
        load_bytes(now + x, second);
        store(0.5F * (first + second), mean + x);
        store(second - first, change + x);
    }
}

TRICUE_MULTIWIDTH(compare, compare_by,
                  (const std::uint8_t* before, const std::uint8_t* now, int n, float* mean, float* change),
                  (before, now, n, mean, change))

}  // namespace

FrameRows::FrameRows(const ImageView& image, int x0, int n)
    : image_(image),
      x0_(x0),
      room_(x0 >= 0 && x0 + n <= image.cols ? std::size_t{0} : static_cast<std::size_t>(n)) {}

const std::uint8_t* FrameRows::row(int y) {
    const std::uint8_t* row = image_.row(std::clamp(y, 0, image_.rows - 1));
    if (room_.empty()) return row + x0_;
    const auto n = static_cast<int>(room_.size());
    const int begin = std::clamp(-x0_, 0, n), end = std::clamp(image_.cols - x0_, begin, n);
    // If only part of the image is kept, its ends exist only if they are requested.
    if (begin > 0) std::fill(room_.begin(), room_.begin() + begin, row[0]);
    std::copy(row + x0_ + begin, row + x0_ + end, room_.begin() + begin);
    if (end < n) std::fill(room_.begin() + end, room_.end(), row[image_.cols - 1]);
    return room_.data();
}

void compare_rows(const std::uint8_t* before, const std::uint8_t* now, int n, const ComparedRow& out) {
    compare(before, now, n, out.mean, out.change);
}

}  // namespace tricue
