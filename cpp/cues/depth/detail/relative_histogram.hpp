// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/arrays.hpp"

namespace tricue {

/// A histogram of depths relative to a depth z: L levels of [-reach, reach) meters.
///
/// A measured depth counts if its level floor((depth - (z - reach)) (L / (2 reach))) is in [0, L). In float32, to which z - reach and
/// L / (2 reach) are rounded.
class RelativeHistogram {
public:
    /// For `samples` depths at a time. @throws std::invalid_argument unless reach is finite and above 0
    RelativeHistogram(Eigen::Index levels, double reach, std::size_t samples);

    /// How many depths are read at a time: `samples`, padded.
    static std::size_t padded(std::size_t samples);

    /// @param depths `samples` depths, meters, then 0 up to `padded(samples)`; a number that isn't above 0 and finite is no
    ///     measurement
    void count(const float* depths, double z);

    /// The three steps of `count`. With many histograms, do each step for several of them before the next one, which would
    /// otherwise wait for the data just written.
    void read(const float* depths, double z);
    void count();
    void finish();

    /// Counts two histograms with equal numbers of samples at once: neighbors mostly share a level, and reading a count just
    /// written is slow.
    void count_beside(RelativeHistogram& other);

    Vector shares() const;  ///< (levels,) with sum 1; all 0 if nothing counts
    /// How many samples count.
    double total() const {
        return static_cast<double>(level_.size()) - counts_[static_cast<std::size_t>(levels_)];
    }
    double samples() const { return static_cast<double>(samples_); }

    /// The distance of equation (38) between the normalized histogram and a model, divided by sqrt 2; 1 if nothing counts.
    double distance(VectorRef model) const;

    /// The sum of squared differences between the counts and the model's share of their total, for find_distances.
    double squared_differences(VectorRef model) const;

private:
    double reach_;
    int levels_;
    std::size_t samples_;
    std::vector<std::int32_t> level_;
    std::size_t table_;
    /// Counts of each level and of samples that don't count, padded to `table_`; then kLanes - 1 more such tables.
    std::vector<std::int32_t> counts_;
};

/// RelativeHistogram::distance of n histograms, from their squared_differences and totals: square roots and divisions of several at
/// once take little longer than those of one.
void find_distances(const double* squares, const double* totals, std::size_t n, double* distances);

/// How many of n depths were measured and are below a limit.
int count_below(const float* depth, std::size_t n, double limit);

/// How many of n depths were measured and count in the one level [z - reach, z + reach).
int count_within(const float* depth, std::size_t n, double z, double reach);

/// @throws std::invalid_argument unless it is a histogram of at least one level, of sum 1 or 0, none negative
void require_model(VectorRef model);

/// @throws std::invalid_argument unless it is finite and not negative
void require_occluder_margin(double occluder_margin);

}  // namespace tricue
