// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "base/arrays.hpp"
#include "base/pixel_runs.hpp"
#include "cues/depth/depth_histogram.hpp"
#include "cues/depth/detail/bit_image.hpp"

namespace tricue {

/// The distances of the pixels where objects are looked for, row by row.
///
/// Before a camera that doesn't move these pixels are few, and apart: then they are listed. A row with many is kept whole, with
/// infinite distances at its others: to list them takes longer than to divide all.
class SearchedDistances {
public:
    SearchedDistances(int rows, int cols);

    /// Those of a row whose mask isn't 0; row after row.
    void add_row(int y, const float* distance, const std::uint8_t* mask);

    Vector histogram(const DepthLevels& levels);

    /// The runs of pixels in the same division; without pixels that are alone, unless these count.
    PixelRuns runs(VectorRef dividers, bool single);

private:
    /// Distances that don't count, up to a whole block.
    void fill_last_block();

    /// Labels of pixels that are listed, into a row of which nothing else is read. What is in no division is searched no longer.
    void add_labels(int y, const std::uint8_t* labels, const std::int32_t* columns, int count,
                    std::uint8_t* row);

    int rows_, cols_;
    BitImage bits_;
    std::vector<int> counts_;   ///< of each row; of a whole one all of it
    Eigen::ArrayXi columns_;    ///< of the pixels that are listed; used as far as listed_
    Eigen::ArrayXf distances_;  ///< used as far as size_
    std::ptrdiff_t listed_ = 0, size_ = 0;
};

}  // namespace tricue
