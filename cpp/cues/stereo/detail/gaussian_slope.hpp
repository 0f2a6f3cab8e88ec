// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "cues/stereo/detail/gray_plane.hpp"

namespace tricue {

/// The derivative of a Gaussian, as halves of an even and an odd row of 2 reach + 1 weights.
struct GaussianSlope {
    static constexpr int kMaxReach = 15;

    /// @param sigma pixels, 0.5 to 6; reach is 2.5 sigma, rounded up
    explicit GaussianSlope(double sigma);

    int reach;
    std::array<float, kMaxReach + 1> smooth;  ///< of the middle and those beside it; all sum to 1
    std::array<float, kMaxReach + 1>
        slope;  ///< of the right half, the left is its negative; 1 on a ramp of 1 a pixel
};

/// The x-derivative of a picture, smoothed by a Gaussian along both axes, row by row.
class SlopeRows {
public:
    /// @param level  shows `reach` more than [x0, x1) and the rows asked for, as far as the picture goes
    /// @param x0, x1 columns that are wanted, in the picture; the edge's value goes on for `padding` more on each side
    SlopeRows(const GrayLevel& level, const GaussianSlope& filter, int x0, int x1, int padding);

    /// Row y, in the picture; row(y)[x], x in [x0 - padding, x1 + padding). Valid until the next call.
    const float* row(int y);

private:
    template <typename Picture>
    auto around(const Picture& picture, int y, int x) const;

    GrayLevel level_;
    GaussianSlope filter_;
    int x0_, x1_, padding_;
    std::vector<float> smooth_, slope_;
};

}  // namespace tricue
