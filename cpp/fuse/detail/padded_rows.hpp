// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace tricue {

/// A matrix whose rows begin where a cache line does, since registers that reach over the end of one take twice as long to load. They
/// end with a whole line; nobody counts on what is in it beyond their columns. It begins with zeros.
class PaddedRows {
public:
    static constexpr int kLine = 16;  ///< floats

    PaddedRows(int rows, int cols)
        : rows_(rows),
          cols_(cols),
          pitch_(std::ptrdiff_t{(cols + kLine - 1) / kLine} * kLine),
          numbers_(static_cast<std::size_t>(rows * pitch_ + kLine)) {
        void* begin = numbers_.data();
        std::size_t room = numbers_.size() * sizeof(float);
        first_ = static_cast<float*>(std::align(kLine * sizeof(float), 1, begin, room));
    }
    PaddedRows(const PaddedRows&) = delete;  // rows would be the other's
    PaddedRows& operator=(const PaddedRows&) = delete;

    int rows() const { return rows_; }
    int cols() const { return cols_; }
    std::ptrdiff_t pitch() const { return pitch_; }  ///< numbers from a row to the next

    float* row(int y) { return first_ + pitch_ * y; }
    const float* row(int y) const { return first_ + pitch_ * y; }

private:
    int rows_, cols_;
    std::ptrdiff_t pitch_;
    std::vector<float> numbers_;
    float* first_;
};

}  // namespace tricue
