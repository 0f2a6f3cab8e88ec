// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "base/stack_view.hpp"

namespace tricue {

/// Contiguous planes of the same size, not initialized. They are never a multiple of 4096 bytes apart: otherwise, numbers at
/// the same place in each plane would share a cache set, which holds fewer of them than there are planes.
class FloatPlanes {
public:
    FloatPlanes(int planes, int rows, int cols)
        : planes_(planes),
          rows_(rows),
          cols_(cols),
          pitch_(size() + (size() % kSetFloats == 0 ? kLineFloats : 0)),
          numbers_(new float[static_cast<std::size_t>(planes * pitch_)]) {}

    int planes() const { return planes_; }
    std::ptrdiff_t size() const { return std::ptrdiff_t{rows_} * cols_; }  ///< numbers of a plane
    std::ptrdiff_t pitch() const { return pitch_; }  ///< numbers from a plane to the next

    float* plane(int k) { return numbers_.get() + k * pitch_; }
    const float* plane(int k) const { return numbers_.get() + k * pitch_; }
    FloatStack view() const { return {numbers_.get(), planes_, rows_, cols_, pitch_}; }

private:
    static constexpr std::ptrdiff_t kSetFloats = 1024, kLineFloats = 16;

    int planes_, rows_, cols_;
    std::ptrdiff_t pitch_;
    std::unique_ptr<float[]> numbers_;
};

}  // namespace tricue
