// SPDX-License-Identifier: MIT
#include "base/row_ring_buffer.hpp"

#include <memory>

namespace tricue {
namespace {

constexpr int kLine = 16;  // floats in a cache line

/// The first cache line: loads that cross a line take twice as long.
float* aligned(std::vector<float>& data) {
    void* begin = data.data();
    std::size_t room = data.size() * sizeof data[0];
    return static_cast<float*>(std::align(kLine * sizeof data[0], 1, begin, room));
}

/// The index of the last row if `count` is rounded up to a power of two.
int last_of_ring(int count) {
    int rows = 1;
    while (rows < count) rows *= 2;
    return rows - 1;
}

/// One cache line more than needed: otherwise rows of several buffers would map to the same cache sets.
std::ptrdiff_t stride_of(int length) {
    return (length + 2 * kLine - 1) / (2 * kLine) * (2 * kLine) + kLine;
}

}  // namespace

RowRingBuffer::RowRingBuffer(int count, int length)
    : last_(last_of_ring(count)),
      data_(static_cast<std::size_t>(stride_of(length)) * (static_cast<std::size_t>(last_) + 1) + kLine) {
    float* first = aligned(data_);
    const int rows = last_ + 1;
    rows_.reserve(2 * static_cast<std::size_t>(rows));
    for (int i = 0; i < 2 * rows; ++i) rows_.push_back(first + (i & last_) * stride_of(length));
}

}  // namespace tricue
