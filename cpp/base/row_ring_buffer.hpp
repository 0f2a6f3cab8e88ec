// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace tricue {

/// The last `count` rows or more, of `length` numbers, initially 0: a new row replaces the oldest. Each begins at a
/// cache line, and is padded to a whole number of pairs of cache lines.
class RowRingBuffer {
public:
    RowRingBuffer(int count, int length);
    RowRingBuffer(const RowRingBuffer&) = delete;  // rows_ points into data_
    RowRingBuffer& operator=(const RowRingBuffer&) = delete;
    RowRingBuffer(RowRingBuffer&&) = default;
    RowRingBuffer& operator=(RowRingBuffer&&) = default;

    float* row(int y) { return rows_[slot(y)]; }

    /// `count` rows from y on, the uppermost first.
    const float* const* from(int y) const { return rows_.data() + slot(y); }

private:
    std::size_t slot(int y) const { return static_cast<std::size_t>(y & last_); }

    int last_;  ///< number of rows minus 1; rows are a power of two, as a division for each row would take as long as filtering it
    std::vector<float> data_;
    std::vector<float*> rows_;  ///< each row twice, so that `count` consecutive pointers can begin at any row
};

}  // namespace tricue
