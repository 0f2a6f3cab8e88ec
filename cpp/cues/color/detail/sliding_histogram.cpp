// SPDX-License-Identifier: MIT
#include "cues/color/detail/sliding_histogram.hpp"

#include <algorithm>

namespace tricue {

SlidingHistogram::SlidingHistogram(const EllipseShape& shape, const CompactBins& image, std::ptrdiff_t start,
                                   std::int32_t unit)
    : image_(image), center_(start), unit_(unit), all_(shape.area * unit), counts_(image.shares.size()) {
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

/// The reverse of a step to the right: the pixels that would leave enter, and those that would enter leave.
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

/// Runs get shorter toward the top and the bottom: the first pixel of a column is in the first run, from above, that reaches it.
void SlidingHistogram::find_boundaries(const EllipseShape& shape) {
    // No structured binding: lambdas can't capture one before C++20.
    const EllipseShape::Run range = shape.column_range();
    const int begin = range.begin, end = range.end;
    Offsets &top = vertical_.leave, &bottom = vertical_.enter;
    for (Offsets* columns : {&top, &bottom}) columns->resize(static_cast<std::size_t>(end - begin));
    const auto count = static_cast<int>(shape.runs.size());
    const auto offset = [&](int row, int column) { return (shape.top + row) * image_.cols + column; };
    // Each row adds the columns that no previous row had.
    const auto close = [&](Offsets& columns, int first, int step, int below) {
        int left = end, right = begin;  // finished columns
        for (int row = first; row >= 0 && row < count; row += step) {
            const auto& run = shape.runs[static_cast<std::size_t>(row)];
            const auto set = [&](int from, int to) {
                for (int column = from; column < to; ++column)
                    columns[static_cast<std::size_t>(column - begin)] = offset(row + below, column);
            };
            if (left >= right) {
                set(run.begin, run.end);
                left = run.begin;
                right = run.end;
                continue;
            }
            set(run.begin, left);
            set(right, run.end);
            left = std::min(left, run.begin);
            right = std::max(right, run.end);
        }
    };
    close(top, 0, 1, 0);
    close(bottom, count - 1, -1, 1);

    // Rows far apart are processed in sequence, because neighbors, often of the same color, would wait for each other's count.
    constexpr int kStreams = 4;
    const int part = (count + kStreams - 1) / kStreams;
    for (Offsets* rows : {&horizontal_.leave, &horizontal_.enter}) rows->reserve(shape.runs.size());
    for (int k = 0; k < part; ++k)
        for (int row = k; row < count; row += part) {
            const auto& run = shape.runs[static_cast<std::size_t>(row)];
            horizontal_.leave.push_back(offset(row, run.begin));
            horizontal_.enter.push_back(offset(row, run.end));
        }
}

}  // namespace tricue
