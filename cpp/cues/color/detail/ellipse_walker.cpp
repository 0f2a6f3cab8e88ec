// SPDX-License-Identifier: MIT
#include "cues/color/detail/ellipse_walker.hpp"

#include <algorithm>

namespace tricue {

EllipseWalker::EllipseWalker(const EllipseShape& shape, const SlotImage& image, std::ptrdiff_t start,
                             std::int32_t unit)
    : image_(image), at_(start), unit_(unit), area_(shape.area), counts_(image.shares.size()) {
    make_boundaries(shape);
    std::ptrdiff_t row = start + std::ptrdiff_t{shape.top} * image.cols;
    for (const auto& run : shape.runs) {
        add(row + run.begin, row + run.end);
        row += image.cols;
    }
}

void EllipseWalker::right() {
    exchange(rightward_.leave, rightward_.enter);
    ++at_;
}

/// Back the way of a step to the right: what had left enters, and what had entered leaves.
void EllipseWalker::left() {
    --at_;
    exchange(rightward_.enter, rightward_.leave);
}

void EllipseWalker::down() {
    exchange(downward_.leave, downward_.enter);
    at_ += image_.cols;
}

void EllipseWalker::add(std::ptrdiff_t begin, std::ptrdiff_t end) {
    const std::uint16_t* slots = image_.slots.data();
    for (auto at = begin; at < end; ++at) counts_[slots[at]] += unit_;
    if (image_.marks.empty()) return;
    const std::uint8_t* marks = image_.marks.data();
    for (auto at = begin; at < end; ++at) marked_ += marks[at];
}

void EllipseWalker::exchange(const Offsets& leave, const Offsets& enter) {
    const std::uint16_t* slots = image_.slots.data() + at_;
    std::int32_t* counts = counts_.data();
    const std::int32_t unit = unit_;
    for (std::size_t k = 0; k < leave.size(); ++k) {
        counts[slots[leave[k]]] -= unit;
        counts[slots[enter[k]]] += unit;
    }
    if (image_.marks.empty()) return;
    const std::uint8_t* marks = image_.marks.data() + at_;
    for (std::size_t k = 0; k < leave.size(); ++k) marked_ += marks[enter[k]] - marks[leave[k]];
}

/// Runs lie within one another towards both ends, so that of the runs over a column the last from above is its end.
void EllipseWalker::make_boundaries(const EllipseShape& shape) {
    const auto [begin, end] = shape.widest();
    Offsets &top = downward_.leave, &bottom = downward_.enter;
    for (Offsets* columns : {&top, &bottom}) columns->resize(static_cast<std::size_t>(end - begin));
    for (Offsets* rows : {&rightward_.leave, &rightward_.enter}) rows->reserve(shape.runs.size());

    std::int32_t row = shape.top * image_.cols;
    for (const auto& run : shape.runs) {
        rightward_.leave.push_back(row + run.begin);
        rightward_.enter.push_back(row + run.end);
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
