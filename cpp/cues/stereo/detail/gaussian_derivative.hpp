// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cues/stereo/detail/gray_plane.hpp"

namespace tricue {

/// The derivative of a Gaussian as separable filters: the right halves of 2 reach + 1 weights.
struct GaussianDerivative {
    static constexpr int kMaxReach = 15;

    /// @param sigma pixels, 0.5 to 6; reach is 2.5 sigma, rounded up
    explicit GaussianDerivative(double sigma);

    int reach;
    std::array<float, kMaxReach + 1> smooth;      ///< symmetric; all 2 reach + 1 sum to 1
    std::array<float, kMaxReach + 1> derivative;  ///< antisymmetric; gives 1 on a ramp of 1 per pixel
};

/// The x-derivative of a picture, smoothed by a Gaussian along both axes, a batch of rows at a time.
class DerivativeRows {
public:
    /// @param plane  shows `reach` more than [x0, x1) and the rows asked for, as far as the picture goes
    /// @param x0, x1 columns wanted, inside the picture; the border is replicated for `padding` more on each side
    DerivativeRows(const GrayPlane& plane, const GaussianDerivative& filter, int x0, int x1, int padding);

    /// Computes rows [begin, end) of the picture, at most a batch.
    void filter(int begin, int end);

    /// Row y of the last batch; row(y)[x], x in [x0 - padding, x1 + padding), and a block more.
    const float* row(int y) const { return derivative(y - first_) - x0_; }

private:
    const float* derivative(int i) const { return derivative_.data() + i * derivative_stride_ + padding_; }

    const GrayPlane& plane_;
    GaussianDerivative filter_;
    int x0_, x1_, padding_, first_ = 0;
    std::ptrdiff_t smooth_stride_, derivative_stride_;
    std::vector<float> smooth_, derivative_;  ///< a batch of rows each
};

}  // namespace tricue
