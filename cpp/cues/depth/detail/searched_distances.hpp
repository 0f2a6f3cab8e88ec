// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "base/arrays.hpp"
#include "base/bit_image.hpp"
#include "base/pixel_runs.hpp"
#include "cues/depth/depth_histogram.hpp"

namespace tricue {

/// The distances of the pixels where objects are looked for, row by row.
///
/// With a static camera, these pixels are few and scattered, so they are listed. A row with many is kept whole, with infinite
/// distances at its other pixels, because listing takes longer than dividing all of them.
class SearchedDistances {
public:
    SearchedDistances(int rows, int cols);

    /// Adds the pixels of a row whose mask isn't 0; rows are added in order.
    void add_row(int y, const float* distance, const std::uint8_t* mask);

    Vector histogram(const DepthLevels& levels);

    /// The runs of pixels in the same division; isolated pixels only if `single`.
    PixelRuns runs(VectorRef dividers, bool single);

private:
    /// Fills the last block with distances that don't count.
    void fill_last_block();

    /// Writes the labels of listed pixels into a row; nothing else in it is read. Pixels in no division are removed from the
    /// searched ones.
    void add_labels(int y, const std::uint8_t* labels, const std::int32_t* columns, int count,
                    std::uint8_t* row);

    int rows_, cols_;
    BitImage bits_;
    std::vector<int> counts_;   ///< number of searched pixels of each row; of all pixels if it is kept whole
    Eigen::ArrayXi columns_;    ///< of the pixels that are listed; used as far as listed_
    Eigen::ArrayXf distances_;  ///< used as far as size_
    std::ptrdiff_t listed_ = 0, size_ = 0;
};

}  // namespace tricue
