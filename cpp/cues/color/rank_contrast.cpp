// SPDX-License-Identifier: MIT
#include "cues/color/rank_contrast.hpp"

#include <algorithm>
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

}  // namespace

RankContrast rank_contrast(const ImageView& image, StatesRef ellipses, const Windows& windows,
                           const ColorLook& look) {
    require_shape(ellipses, ellipses.rows(), 4, "ellipses");
    Reader inside(image, windows.inside, "inside"), around(image, windows.around, "around");
    RankMaps maps(look.maps, windows.inside.rows());
    const int bits = bits_of_cube(look.table, "table");
    require_finite(ellipses, "ellipses");

    const Eigen::Index N = ellipses.rows();
    RankContrast measured{States(N, maps.size()), Vector(N)};
    for (Eigen::Index first = 0; first < N; first += EllipseSampler::kBatch) {
        const std::ptrdiff_t count = std::min(N - first, EllipseSampler::kBatch);
        const SampleView within = inside.read(ellipses.data() + 4 * first, count);
        const SampleView without = around.read(ellipses.data() + 4 * first, count);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            maps.compare(within, i, measured.distances.data() + (first + i) * maps.size());
            measured.contrast[first + i] = inside.mean(within, i, bits, look.table.data()) -
                                           around.mean(without, i, bits, look.table.data());
        }
    }
    return measured;
}

}  // namespace tricue
