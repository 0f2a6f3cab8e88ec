// SPDX-License-Identifier: MIT
#include "cues/color/rank_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "cues/color/detail/color_cells.hpp"
#include "cues/color/detail/ellipse_sampler.hpp"
#include "cues/color/detail/rank_maps.hpp"

namespace tricue {
namespace {

/// The samples of a batch of ellipses, and the cells in the table of one of them.
class Reader {
public:
    Reader(const ImageView& image, StatesRef pattern, const char* name) : sampler_(image, pattern, name) {
        if (sampler_.size() < 1) refuse(name, "at least one place", "none");
        planes_.resize(static_cast<std::size_t>(3 * sampler_.size() * EllipseSampler::kBatch));
        cells_.resize(static_cast<std::size_t>(sampler_.size()));
    }

    SampleView read(const double* ellipses, std::ptrdiff_t count) {
        sampler_.read(ellipses, count, planes_.data());
        return {planes_.data(), count, sampler_.size()};
    }

    /// The table's mean over the samples of one ellipse. Not multiversioned: single loads are faster than gathers on processors with
    /// the Downfall mitigation.
    double mean(const SampleView& samples, std::ptrdiff_t ellipse, int bits, const float* table) {
        color_cells(samples, ellipse, bits, cells_.data());
        double sums[4] = {};  // so that an addition needn't wait for the one before
        std::size_t k = 0;
        for (; k + 4 <= cells_.size(); k += 4)
            for (std::size_t lane = 0; lane < 4; ++lane)
                sums[lane] += static_cast<double>(table[cells_[k + lane]]);
        for (; k < cells_.size(); ++k) sums[0] += static_cast<double>(table[cells_[k]]);
        return (sums[0] + sums[1] + sums[2] + sums[3]) / static_cast<double>(samples.n);
    }

private:
    EllipseSampler sampler_;
    std::vector<std::uint8_t> planes_;
    std::vector<std::int32_t> cells_;
};

/// The mean of M distances by their shares, or the least of them.
double combined(const double* distances, const ColorLook& look) {
    const Eigen::Index M = look.shares.size();
    if (look.nearest) return *std::min_element(distances, distances + M);
    double mean = 0.0;
    for (Eigen::Index m = 0; m < M; ++m) mean += look.shares[m] * distances[m];
    return mean;
}

void require_valid(const ColorLook& look, const LookWeights& weights) {
    if (look.maps.rows() < 1) refuse("models", "at least one rank map", "none");
    require_size(look.shares, look.maps.rows(), "shares");
    require_finite(look.shares, "shares");
    if (!std::isfinite(weights.sharpness)) refuse("sharpness", "a finite number", weights.sharpness);
    if (!std::isfinite(weights.contrast)) refuse("contrast_weight", "a finite number", weights.contrast);
}

}  // namespace

Vector rank_likelihood(const ImageView& image, StatesRef ellipses, const Windows& windows,
                       const ColorLook& look, const LookWeights& weights) {
    require_shape(ellipses, ellipses.rows(), 4, "ellipses");
    Reader inside(image, windows.inside, "inside"), around(image, windows.around, "around");
    require_valid(look, weights);
    RankMaps maps(look.maps, windows.inside.rows());
    const int bits = bits_of_cube(look.table, "table");
    require_finite(ellipses, "ellipses");

    const Eigen::Index N = ellipses.rows();
    Vector log_likelihood(N), distances(maps.size());
    for (Eigen::Index first = 0; first < N; first += EllipseSampler::kBatch) {
        const std::ptrdiff_t count = std::min(N - first, EllipseSampler::kBatch);
        const SampleView within = inside.read(ellipses.data() + 4 * first, count);
        const SampleView without = around.read(ellipses.data() + 4 * first, count);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            maps.compare(within, i, distances.data());
            const double distance = combined(distances.data(), look);
            const double contrast = inside.mean(within, i, bits, look.table.data()) -
                                    around.mean(without, i, bits, look.table.data());
            log_likelihood[first + i] = weights.contrast * contrast - weights.sharpness * distance * distance;
        }
    }
    return log_likelihood;
}

}  // namespace tricue
