// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/warped_columns.hpp"

#include <algorithm>

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
    int start;  ///< column of the first pixel, less the base of the disparities
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

}  // namespace

WarpedColumns::WarpedColumns(const DisparityPrior& prior, int x0, int x1, int first, int last, int cols)
    : prior_(prior),
      x0_(x0 - x0 % 2),
      first_(first),
      last_(last),
      cols_(cols),
      skip_(x0 % 2),
      pairs_((x1 - x0_ + 1) / 2),
      offset_(static_cast<std::size_t>(whole_lines(2 * pairs_) + kRowLine), prior.rest),
      share_(offset_.size()),
      visible_(offset_.size()),
      column_(offset_.size()) {
    if (prior.coarse == nullptr) update_columns();
}

void WarpedColumns::move_to(int y) {
    if (prior_.coarse == nullptr || y / 2 == row_) return;
    row_ = y / 2;
    upsample(prior_.coarse->row(row_) + x0_ / 2, pairs_, prior_.rest, offset_.data());
    update_columns();
}

void WarpedColumns::update_columns() {
    find_columns(offset_.data(), whole_lines(2 * pairs_), {x0_ - prior_.base, first_, last_, cols_},
                 column_.data(), share_.data(), visible_.data());
}

}  // namespace tricue
