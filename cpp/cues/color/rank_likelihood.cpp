// SPDX-License-Identifier: MIT
#include "cues/color/rank_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/color_cells.hpp"
#include "cues/color/detail/compare_window.hpp"
#include "cues/color/detail/ellipse_sampler.hpp"
#include "cues/color/detail/rank_maps.hpp"

namespace tricue {
namespace {

/// The samples of a batch of ellipses as words, and the means of the table over them.
class Reader {
public:
    Reader(const ImageView& image, StatesRef pattern, const char* name) : sampler_(image, pattern, name) {
        if (sampler_.size() < 1) refuse(name, "at least one place", "none");
        cells_.resize(static_cast<std::size_t>(sampler_.size() * EllipseSampler::kBatch));
    }

    const EllipseSampler& sampler() const { return sampler_; }

    const std::uint32_t* read(const double* ellipses, std::ptrdiff_t count, int bits) {
        const std::uint32_t* words = sampler_.read_words(ellipses, count);
        word_cells(words, sampler_.size() * count, bits, cells_.data());
        return words;
    }

    /// The table's mean over the samples of one ellipse. Not multiversioned: single loads are faster than gathers on processors with
    /// the Downfall mitigation.
    double mean(std::ptrdiff_t ellipse, const float* table) const {
        const std::ptrdiff_t n = sampler_.size();
        const std::int32_t* cells = cells_.data() + n * ellipse;
        double sums[4] = {};  // so that additions don't wait for each other
        std::ptrdiff_t k = 0;
        for (; k + 4 <= n; k += 4)
            for (std::ptrdiff_t lane = 0; lane < 4; ++lane)
                sums[lane] += static_cast<double>(table[cells[k + lane]]);
        for (; k < n; ++k) sums[0] += static_cast<double>(table[cells[k]]);
        return (sums[0] + sums[1] + sums[2] + sums[3]) / static_cast<double>(n);
    }

private:
    EllipseSampler sampler_;
    std::vector<std::int32_t> cells_;
};

/// The mean of M distances, weighted by their shares, or the smallest.
double combined(const double* distances, const ColorAppearance& appearance) {
    const Eigen::Index M = appearance.shares.size();
    if (appearance.nearest) return *std::min_element(distances, distances + M);
    double mean = 0.0;
    for (Eigen::Index m = 0; m < M; ++m) mean += appearance.shares[m] * distances[m];
    return mean;
}

void require_valid(const ColorAppearance& appearance, const LikelihoodFactors& factors) {
    if (appearance.models.rows() < 1) refuse("models", "at least one rank map", "none");
    require_size(appearance.shares, appearance.models.rows(), "shares");
    require_finite(appearance.shares, "shares");
    if (!std::isfinite(factors.sharpness)) refuse("sharpness", "a finite number", factors.sharpness);
    if (!std::isfinite(factors.contrast_weight))
        refuse("contrast_weight", "a finite number", factors.contrast_weight);
}

}  // namespace

struct RankLikelihood::Parts {
    Reader inside, around;
    RankMaps maps;
    const ColorAppearance& appearance;
    LikelihoodFactors factors;
    int bits;
    Vector distances;
    std::vector<std::uint8_t> planes;
};

RankLikelihood::RankLikelihood(const ImageView& image, const EllipsePattern& pattern,
                               const ColorAppearance& appearance, const LikelihoodFactors& factors) {
    constexpr std::ptrdiff_t kBatch = EllipseSampler::kBatch;
    Reader inside(image, pattern.inside, "inside"), around(image, pattern.around, "around");
    require_valid(appearance, factors);
    RankMaps maps(appearance.models, pattern.inside.rows());
    const int bits = bits_of_cube(appearance.table, "table");
    Vector distances(kBatch * maps.size());
    std::vector<std::uint8_t> planes(static_cast<std::size_t>(3 * pattern.inside.rows() * kBatch));
    parts_ = std::make_unique<Parts>(Parts{std::move(inside), std::move(around), std::move(maps), appearance,
                                           factors, bits, std::move(distances), std::move(planes)});
}

RankLikelihood::~RankLikelihood() = default;

Vector RankLikelihood::log_likelihood(StatesRef ellipses) {
    require_shape(ellipses, ellipses.rows(), 4, "ellipses");
    require_finite(ellipses, "ellipses");
    auto& [inside, around, maps, appearance, factors, bits, distances, planes] = *parts_;
    const Eigen::Index N = ellipses.rows(), M = maps.size();
    const std::ptrdiff_t n = inside.sampler().size();
    constexpr std::ptrdiff_t kBatch = EllipseSampler::kBatch;
    Vector log_likelihood(N);
    for (Eigen::Index first = 0; first < N; first += kBatch) {
        const std::ptrdiff_t count = std::min(N - first, kBatch);
        const double* each = ellipses.data() + 4 * first;
        const std::uint32_t* words = inside.read(each, count, bits);
        around.read(each, count, bits);
        inside.sampler().split(words, count, planes.data());
        maps.compare({planes.data(), count, n}, distances.data());
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const double distance = combined(distances.data() + M * i, appearance);
            const double contrast =
                inside.mean(i, appearance.table.data()) - around.mean(i, appearance.table.data());
            log_likelihood[first + i] =
                factors.contrast_weight * contrast - factors.sharpness * distance * distance;
        }
    }
    return log_likelihood;
}

RankWindow RankLikelihood::first_window(double flat) const {
    return compare_window(parts_->planes.data(), parts_->inside.sampler().size(), parts_->appearance.models,
                          flat);
}

Vector rank_likelihood(const ImageView& image, StatesRef ellipses, const EllipsePattern& pattern,
                       const ColorAppearance& appearance, const LikelihoodFactors& factors) {
    require_shape(ellipses, ellipses.rows(), 4, "ellipses");
    return RankLikelihood(image, pattern, appearance, factors).log_likelihood(ellipses);
}

}  // namespace tricue
