// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cues/color/detail/ellipse_shape.hpp"
#include "cues/color/detail/slot_image.hpp"

namespace tricue {

/// A shape that is moved over an image of slots, one pixel a step, and what it holds: only its outline's pixels leave and enter.
class EllipseWalker {
public:
    /// @param image must outlive it, and hold the shape wherever it's moved to
    /// @param start the offset of the pixel that the shape is relative to
    /// @param unit  what one pixel counts
    EllipseWalker(const EllipseShape& shape, const SlotImage& image, std::ptrdiff_t start, std::int32_t unit);

    void right();
    void left();
    void down();

    const std::int32_t* counts() const { return counts_.data(); }              ///< units in each slot
    int marked() const { return marked_; }                                     ///< pixels that have a mark
    int seen() const { return area_ - counts_[SlotImage::kOutside] / unit_; }  ///< pixels inside the image

private:
    using Offsets = std::vector<std::int32_t>;

    /// The pixels of a shape at which the next step leaves it, and those just beyond that enter.
    struct Boundary {
        Offsets leave, enter;
    };

    void make_boundaries(const EllipseShape& shape);
    void add(std::ptrdiff_t begin, std::ptrdiff_t end);
    void exchange(const Offsets& leave, const Offsets& enter);

    const SlotImage& image_;
    std::ptrdiff_t at_;
    std::int32_t unit_;
    int area_, marked_ = 0;
    std::vector<std::int32_t> counts_;
    Boundary rightward_, downward_;
};

}  // namespace tricue
