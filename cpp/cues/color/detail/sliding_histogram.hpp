// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ellipse_shape.hpp"
#include "cues/color/detail/compact_bins.hpp"

namespace tricue {

/// The histogram under a shape that moves over an image pixel by pixel, where only pixels at its outline leave and enter.
class SlidingHistogram {
public:
    /// @param image must outlive the histogram, and contain the shape wherever it is moved
    /// @param start the offset of the pixel that the shape is relative to
    /// @param unit  what one pixel counts; the units of the whole shape fit 31 bits
    SlidingHistogram(const EllipseShape& shape, const CompactBins& image, std::ptrdiff_t start,
                     std::int32_t unit);

    void move_right();
    void move_left();
    void move_down();

    const std::int32_t* counts() const { return counts_.data(); }  ///< units of each index
    /// Units of the pixels inside the image.
    std::int32_t visible() const { return all_ - counts_[CompactBins::kOutside]; }

    using Offsets = std::vector<std::int32_t>;

    /// Offsets of the pixels that leave the shape in a step, and of those that enter it.
    struct Boundary {
        Offsets leave, enter;
    };

    const Boundary& horizontal() const { return horizontal_; }  ///< of a step to the right
    const Boundary& vertical() const { return vertical_; }      ///< of a step down

private:
    void find_boundaries(const EllipseShape& shape);
    void add(std::ptrdiff_t begin, std::ptrdiff_t end);
    void replace(const Offsets& leave, const Offsets& enter);

    const CompactBins& image_;
    std::ptrdiff_t center_;
    std::int32_t unit_, all_;  ///< of one pixel, and of the whole shape
    std::vector<std::int32_t> counts_;
    Boundary horizontal_, vertical_;
};

}  // namespace tricue
