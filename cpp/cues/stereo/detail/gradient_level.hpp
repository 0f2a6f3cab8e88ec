// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "base/row_ring_buffer.hpp"
#include "cues/stereo/detail/gaussian_derivative.hpp"
#include "cues/stereo/detail/gray_plane.hpp"
#include "cues/stereo/detail/warped_columns.hpp"

namespace tricue {

/// Means over the window around each pixel of a row. With s = (f_x^R + f_x^L) / 2 and t = s offset + f^R - f^L, equation (7) says
/// t = s times the wanted offset d - base; f is the brightness.
struct WindowMeans {
    const float *ss, *st;                   ///< s², s t
    const float *tt, *power, *reliability;  ///< t², f_L² + f_R², (9); only of the finest level
};

/// The parts of its pictures that a level needs; inside them, not empty.
struct LevelRegions {
    Region wanted;       ///< the pixels to measure
    Region pooled;       ///< those of their windows
    int first, last;     ///< columns of the right picture where those can be, both included
    Region left, right;  ///< what filters read
};

/// @param predicted   disparity, pixels of this level
/// @param uncertainty how far from that the expected disparities may be
LevelRegions find_level_regions(const Region& wanted, int rows, int cols, int radius, int reach,
                                double predicted, double uncertainty);

/// One level of gradient_disparity, row by row.
class GradientLevel {
public:
    /// @param left, right show parts.left and parts.right
    /// @param finest      all means are wanted, else two
    GradientLevel(const GrayLevel& left, const GrayLevel& right, const LevelRegions& parts,
                  const GaussianDerivative& filter, int radius, const DisparityPrior& known, bool finest);

    /// Calls done(y, means, here) for each row; `here` are the expected disparities of its pixels. The finest level's
    /// reliabilities are written to reliability(y).
    template <typename Reliability, typename Done>
    void run(const Reliability& reliability, const Done& done) {
        for (int y = wanted_.y0 - radius_; y < wanted_.y1 + radius_; ++y) {
            add_row(y);
            const int middle = y - radius_;
            if (middle < wanted_.y0) continue;
            center_.move_to(middle);
            done(middle, means(reliability(middle)), center_);
        }
    }

private:
    static constexpr std::size_t kMeans = 5;

    void add_row(int y);
    WindowMeans means(float* reliability);
    RowRingBuffer ring(bool wanted) const;

    int radius_, rows_;
    std::size_t count_;  ///< of means: 2 or kMeans
    Region wanted_, pooled_;
    DerivativeRows left_, right_;
    WarpedColumns incoming_,
        center_;  ///< of the row that comes into the window, and of the one in its middle
    int latest_ = 0;
    std::vector<float> taps_, shifted_, slope_;
    std::array<RowRingBuffer, kMeans> rings_;  ///< rows of what the means are of
    RowRingBuffer columns_, means_;            ///< a row for each mean
};

}  // namespace tricue
