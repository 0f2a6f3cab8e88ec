// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "camera/arrays.hpp"
#include "camera/depth_view.hpp"

namespace tricue {

/// Reads the depths in one rectangle after the other at the places of a pattern, and counts them by level relative to the
/// rectangle's own depth: what depth_distance and rectangle_histogram are made of, where all is defined. The image must outlive it.
class DepthReader {
public:
    /// @throws std::invalid_argument on a pattern that isn't (n, 2), n at least 1, or not finite, and on another reach or `nearer`
    DepthReader(const DepthView& depth, StatesRef pattern, Eigen::Index levels, double reach, double nearer);

    /// Reads a rectangle of five finite numbers: centre x, y, width, height, z.
    void read(const double* rectangle);

    const std::int32_t* counts() const { return counts_.data(); }  ///< of each level
    double places() const { return static_cast<double>(seen_.size()); }
    double counted() const { return places() - counts_.back(); }
    double before() const { return before_; }  ///< how many are nearer than z - nearer

private:
    DepthView depth_;
    double reach_, nearer_;
    int before_ = 0;
    Vector u_, v_;
    std::vector<std::int32_t> column_, row_, level_;
    std::vector<float> seen_;
    std::vector<std::int32_t> counts_;  ///< the last: of what doesn't count
};

}  // namespace tricue
