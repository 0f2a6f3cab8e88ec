// SPDX-License-Identifier: MIT
#include "cues/color/best_ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/check.hpp"
#include "base/ellipse_shape.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Counts = std::vector<std::int32_t>;

double score_of(const double* measured, const ScoreWeights& weights) {
    const double depth = weights.depth * (measured[2] - weights.depth_ring * measured[3]);
    return measured[0] - weights.ring * measured[1] + depth;
}

/// Counts the pixels of each bin in an ellipse moved by whole pixels, all or only those in the mask; returns their number.
std::int32_t count(const BinsView& bins, const ImageView* mask, const EllipseShape& shape, int x, int y,
                   Counts& counts) {
    std::int32_t total = 0;
    for (std::size_t k = 0; k < shape.runs.size(); ++k) {
        const int row = y + shape.top + static_cast<int>(k);
        if (row < 0 || row >= bins.rows) continue;
        const std::uint16_t* line = bins.row(row);
        const std::uint8_t* marks = mask ? mask->row(row) : nullptr;
        const int end = std::min(x + shape.runs[k].end, bins.cols);
        for (int col = std::max(x + shape.runs[k].begin, 0); col < end; ++col) {
            if (line[col] == kNoBin || (marks && marks[col] == 0)) continue;
            ++counts[line[col]];
            ++total;
        }
    }
    return total;
}

TRICUE_MULTIVERSION
void divide(const std::int32_t* __restrict counts, std::size_t n, double total, double* __restrict shares) {
    for (std::size_t i = 0; i < n; ++i) shares[i] = counts[i] / total;
}

}  // namespace

BestEllipse best_ellipse(const BinsView& bins, VectorRef ellipse, const SearchGrid& grid,
                         const SearchModel& model, const ImageView& mask, const ScoreWeights& weights,
                         int min_marked) {
    for (const double weight : {weights.ring, weights.depth, weights.depth_ring})
        if (!std::isfinite(weight)) refuse("weights", "finite numbers", weight);
    if (min_marked < 0) refuse("min_marked", "0 or more", min_marked);

    const States measured = ellipse_search(bins, ellipse, grid, model, mask);
    Eigen::Index best = 0;
    double most = score_of(measured.data(), weights);
    for (Eigen::Index place = 1; place < measured.rows(); ++place)
        if (const double score = score_of(measured.row(place).data(), weights); score > most) {
            best = place;
            most = score;
        }

    const int row = static_cast<int>(best) / grid.cols, col = static_cast<int>(best) % grid.cols;
    const CenterPixel center(ellipse.data());
    const EllipseShape shape(ellipse.data(), 1.0);
    const int x = center.x + (col - grid.cols / 2) * grid.step,
              y = center.y + (row - grid.rows / 2) * grid.step;
    Counts counts(static_cast<std::size_t>(model.histogram.size()), 0);
    std::int32_t total = 0;
    if (min_marked > 0) total = count(bins, &mask, shape, x, y, counts);
    if (total < std::max(min_marked, 1)) {
        std::fill(counts.begin(), counts.end(), 0);
        total = count(bins, nullptr, shape, x, y, counts);
    }
    BestEllipse found{row, col, most, measured(best, 0), measured(best, 2), Vector(model.histogram.size())};
    divide(counts.data(), counts.size(), std::max(total, 1), found.histogram.data());
    return found;
}

}  // namespace tricue
