// SPDX-License-Identifier: MIT
#include "cues/color/ellipse_histogram.hpp"

#include <algorithm>

#include "cues/color/detail/ellipse_shape.hpp"

namespace tricue {
namespace {

/// One row of the image, which counts only from its first to its last pixel.
class Row {
public:
    Row(const BinsView& bins, const ImageView& mask, int y, int x)
        : bins_(bins.row(y)), mask_(mask.data ? mask.row(y) : nullptr), x_(x), cols_(bins.cols) {}

    void count(int begin, int end, std::int32_t* counts) const {
        const int last = std::min(x_ + end, cols_);
        for (int x = std::max(x_ + begin, 0); x < last; ++x)
            if (bins_[x] != kNoBin && (mask_ == nullptr || mask_[x] != 0)) ++counts[bins_[x]];
    }

private:
    const std::uint16_t* bins_;
    const std::uint8_t* mask_;
    int x_, cols_;
};

void count(const BinsView& bins, const ImageView& mask, const double* ellipse, double margin,
           std::int32_t* inside, std::int32_t* around) {
    const CenterPixel place(ellipse);
    const EllipseShape inner(ellipse, 1.0), outer(ellipse, margin);
    const int last = std::min(outer.bottom(), bins.rows - place.y);
    for (int y = std::max(outer.top, -place.y); y < last; ++y) {
        const Row row(bins, mask, place.y + y, place.x);
        const auto [left, right] = outer.runs[static_cast<std::size_t>(y - outer.top)];
        if (y < inner.top || y >= inner.bottom()) {
            row.count(left, right, around);
            continue;
        }
        const auto [begin, end] = inner.runs[static_cast<std::size_t>(y - inner.top)];
        row.count(left, begin, around);
        row.count(begin, end, inside);
        row.count(end, right, around);
    }
}

}  // namespace

EllipseCounts ellipse_histogram(const BinsView& bins, StatesRef ellipses, int size, double margin,
                                const ImageView& mask) {
    require_ellipses(ellipses, margin, "ellipses");
    require_bins(bins, size);
    require_mask(mask, bins);

    EllipseCounts counts{Counts::Zero(ellipses.rows(), size), Counts::Zero(ellipses.rows(), size)};
    for (Eigen::Index i = 0; i < ellipses.rows(); ++i)
        count(bins, mask, ellipses.data() + 4 * i, margin, counts.inside.data() + i * size,
              counts.around.data() + i * size);
    return counts;
}

}  // namespace tricue
