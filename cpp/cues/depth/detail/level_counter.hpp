// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/arrays.hpp"

namespace tricue {

/// Counts depths by level relative to a depth z: L levels of [-reach, reach) metres. What depth_distance, depth_contrast and
/// rectangle_histogram have in common.
///
/// What was measured counts where its level floor(((depth - z) + reach) (L / (2 reach))), in float64, is in [0, L).
class LevelCounter {
public:
    /// Of `places` depths at a time. @throws std::invalid_argument unless reach is finite and above 0
    LevelCounter(Eigen::Index levels, double reach, std::size_t places);

    /// @param seen `places` depths, metres; nothing was measured where one isn't above 0 and finite
    void count(const float* seen, double z);

    const std::int32_t* counts() const { return counts_.data(); }  ///< of each level
    double counted() const { return places() - counts_[static_cast<std::size_t>(levels_)]; }  ///< how many
    double places() const { return static_cast<double>(level_.size()); }

    /// Equation (38) between the shares of what counts and a model, over sqrt 2; 1 where nothing counts.
    double distance(VectorRef model) const;

private:
    double reach_;
    int levels_;
    std::vector<std::int32_t> level_;
    std::vector<std::int32_t> counts_;  ///< of each level, and of what doesn't count; then more such tables
};

/// How many of n depths were measured and are below a limit.
int count_below(const float* depth, std::size_t n, double limit);

/// How many of n depths were measured and count in the one level [z - reach, z + reach).
int count_within(const float* depth, std::size_t n, double z, double reach);

/// @throws std::invalid_argument unless it is a histogram of at least one level, of sum 1 or 0, none negative
void require_model(VectorRef model);

/// @throws std::invalid_argument unless it is finite and not negative
void require_nearer(double nearer);

}  // namespace tricue
