// SPDX-License-Identifier: MIT
#include "cues/color/detail/sliding_histogram.hpp"

#include <algorithm>

namespace tricue {

SlidingHistogram::SlidingHistogram(const EllipseShape& shape, const CompactBins& image, std::ptrdiff_t start,
                                   std::int32_t unit)
    : image_(image), center_(start), unit_(unit), area_(shape.area), counts_(image.shares.size()) {
    find_boundaries(shape);
    std::ptrdiff_t row = start + std::ptrdiff_t{shape.top} * image.cols;
    for (const auto& run : shape.runs) {
        add(row + run.begin, row + run.end);
        row += image.cols;
    }
}

void SlidingHistogram::move_right() {
    replace(horizontal_.leave, horizontal_.enter);
    ++center_;
}

/// The reverse of a step to the right: what left then enters now, and what entered leaves.
void SlidingHistogram::move_left() {
    --center_;
    replace(horizontal_.enter, horizontal_.leave);
}

void SlidingHistogram::move_down() {
    replace(vertical_.leave, vertical_.enter);
    center_ += image_.cols;
}

void SlidingHistogram::add(std::ptrdiff_t begin, std::ptrdiff_t end) {
    const std::uint16_t* indices = image_.indices.data();
    for (auto at = begin; at < end; ++at) counts_[indices[at]] += unit_;
}

void SlidingHistogram::replace(const Offsets& leave, const Offsets& enter) {
    const std::uint16_t* indices = image_.indices.data() + center_;
    std::int32_t* counts = counts_.data();
    const std::int32_t unit = unit_;
    for (std::size_t k = 0; k < leave.size(); ++k) {
        counts[indices[leave[k]]] -= unit;
        counts[indices[enter[k]]] += unit;
    }
}

/// Runs get shorter towards the top and the bottom, so the last run over a column, from above, is its lower end.
void SlidingHistogram::find_boundaries(const EllipseShape& shape) {
    const auto [begin, end] = shape.column_range();
    Offsets &top = vertical_.leave, &bottom = vertical_.enter;
    for (Offsets* columns : {&top, &bottom}) columns->resize(static_cast<std::size_t>(end - begin));
    for (Offsets* rows : {&horizontal_.leave, &horizontal_.enter}) rows->reserve(shape.runs.size());

    std::int32_t row = shape.top * image_.cols;
    for (const auto& run : shape.runs) {
        horizontal_.leave.push_back(row + run.begin);
        horizontal_.enter.push_back(row + run.end);
        row += image_.cols;
        std::fill(bottom.begin() + (run.begin - begin), bottom.begin() + (run.end - begin), row);
    }
    for (auto run = shape.runs.rbegin(); run != shape.runs.rend(); ++run) {
        row -= image_.cols;
        std::fill(top.begin() + (run->begin - begin), top.begin() + (run->end - begin), row);
    }
    for (int column = begin; column < end; ++column) {
        top[static_cast<std::size_t>(column - begin)] += column;
        bottom[static_cast<std::size_t>(column - begin)] += column;
    }
}

}  // namespace tricue
