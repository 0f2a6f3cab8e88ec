// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace tricue {

/// A matrix whose rows begin at cache lines, since loads that cross a line take twice as long. Rows are padded to whole lines, with
/// unspecified numbers. Initially all numbers are 0.
class AlignedMatrix {
public:
    static constexpr int kLineFloats = 16;  ///< floats

    AlignedMatrix(int rows, int cols)
        : rows_(rows),
          cols_(cols),
          pitch_(std::ptrdiff_t{(cols + kLineFloats - 1) / kLineFloats} * kLineFloats),
          numbers_(static_cast<std::size_t>(rows * pitch_ + kLineFloats)) {
        void* begin = numbers_.data();
        std::size_t room = numbers_.size() * sizeof(float);
        first_ = static_cast<float*>(std::align(kLineFloats * sizeof(float), 1, begin, room));
    }
    AlignedMatrix(const AlignedMatrix&) = delete;  // first_ points into numbers_
    AlignedMatrix& operator=(const AlignedMatrix&) = delete;

    int rows() const { return rows_; }
    int cols() const { return cols_; }
    std::ptrdiff_t pitch() const { return pitch_; }  ///< numbers from one row to the next

    float* row(int y) { return first_ + pitch_ * y; }
    const float* row(int y) const { return first_ + pitch_ * y; }

private:
    int rows_, cols_;
    std::ptrdiff_t pitch_;
    std::vector<float> numbers_;
    float* first_;
};

}  // namespace tricue
