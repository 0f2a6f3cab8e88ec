// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/warped_columns.hpp"

#include <algorithm>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void upsample(const float* __restrict coarse, int n, float rest, float* __restrict fine) {
    for (int i = 0; i < n; ++i) {
        const float offset = 2.0F * coarse[i] + rest;
        fine[2 * i] = offset;
        fine[2 * i + 1] = offset;
    }
}

struct Columns {
    int start;  ///< column of the first pixel, minus the base of the disparities
    int first, last, cols;
};

TRICUE_MULTIVERSION
void find_columns(const float* __restrict offset, int n, const Columns& at, int* __restrict column,
                  float* __restrict share, float* __restrict visible) {
    const int start = at.start, first = at.first, last = at.last, edge = at.cols - 1;
    for (int x = 0; x < n; ++x) {
        const float shift = -offset[x];
        const int cut = static_cast<int>(shift), whole = cut - (shift < static_cast<float>(cut) ? 1 : 0);
        const float part = shift - static_cast<float>(whole);
        const int found = start + x + whole;
        const bool inside = (found >= 0) & ((found < edge) | ((found == edge) & (part == 0.0F)));
        share[x] = part;
        visible[x] = inside ? 1.0F : 0.0F;
        column[x] = std::min(std::max(found, first), last);
    }
}

/// The last of the slots, a power of two, for the rows of the coarser level that `kept` rows have.
int last_slot(const DisparityPrior& prior, int kept) {
    int slots = 1;
    while (prior.coarse != nullptr && slots < kept / 2 + 1) slots *= 2;
    return slots - 1;
}

}  // namespace

WarpedColumns::WarpedColumns(const DisparityPrior& prior, int x0, int x1, int first, int last, int cols,
                             int kept)
    : prior_(prior),
      x0_(x0 - x0 % 2),
      first_(first),
      last_(last),
      cols_(cols),
      skip_(x0 % 2),
      pairs_((x1 - x0_ + 1) / 2),
      last_slot_(last_slot(prior, kept)),
      stride_(static_cast<std::size_t>(whole_blocks(2 * pairs_) + kRowBlock)),
      offset_(stride_ * static_cast<std::size_t>(last_slot_ + 1), prior.rest),
      share_(offset_.size()),
      visible_(offset_.size()),
      column_(offset_.size()) {
    if (prior.coarse == nullptr) update(0);
}

void WarpedColumns::add_row(int y) {
    if (prior_.coarse == nullptr || y / 2 == row_) return;
    row_ = y / 2;
    upsample(prior_.coarse->row(row_) + x0_ / 2, pairs_, prior_.rest, offset_.data() + slot(y) * stride_);
    update(slot(y));
}

WarpedRow WarpedColumns::row(int y) const {
    const std::size_t at = slot(y) * stride_ + static_cast<std::size_t>(skip_);
    return {offset_.data() + at, share_.data() + at, visible_.data() + at, column_.data() + at};
}

void WarpedColumns::update(std::size_t slot) {
    const std::size_t at = slot * stride_;
    find_columns(offset_.data() + at, whole_blocks(2 * pairs_), {x0_ - prior_.base, first_, last_, cols_},
                 column_.data() + at, share_.data() + at, visible_.data() + at);
}

}  // namespace tricue
