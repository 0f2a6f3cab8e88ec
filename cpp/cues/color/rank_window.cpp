// SPDX-License-Identifier: MIT
#include "cues/color/rank_window.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/color_ranks.hpp"
#include "cues/color/detail/ellipse_sampler.hpp"
#include "cues/color/detail/rank_maps.hpp"

namespace tricue {
namespace {

/// In four sums, so that an addition needn't wait for the one before.
TRICUE_MULTIVERSION
void dot_product(const float* a, const float* b, std::ptrdiff_t n, double* product) {
    using Lanes = Pack<double, 4>;
    Lanes sums = {};
    std::ptrdiff_t k = 0;
    for (; k + 4 <= n; k += 4) {
        Pack<float, 4> four;
        Lanes left, right;
        load(a + k, four);
        convert(four, left);
        load(b + k, four);
        convert(four, right);
        sums += left * right;
    }
    for (; k < n; ++k) sums[0] += static_cast<double>(a[k]) * static_cast<double>(b[k]);
    *product = sum(sums);
}

double dot(const float* a, const float* b, std::ptrdiff_t n) {
    double product = 0.0;
    dot_product(a, b, n, &product);
    return product;
}

}  // namespace

RankWindow rank_window(const ImageView& image, VectorRef ellipse, StatesRef pattern, FloatsRef models,
                       double flat) {
    require_size(ellipse, 4, "ellipse");
    require_finite(ellipse, "ellipse");
    if (pattern.rows() < 1) refuse("pattern", "at least one place", "none");
    if (!(flat >= 0.0)) refuse("flat", "a number from 0", flat);
    EllipseSampler sampler(image, pattern, "pattern");
    require_rank_maps(models, sampler.size());

    const std::ptrdiff_t size = 3 * sampler.size();
    std::vector<std::uint8_t> planes(static_cast<std::size_t>(size));
    sampler.read(ellipse.data(), 1, planes.data());
    Floats ranks = color_ranks({planes.data(), 1, sampler.size()});

    const double even = static_cast<double>(size) / 4.0;
    const double own = dot(ranks.data(), ranks.data(), size) - even;
    Vector correlations(models.rows());
    for (Eigen::Index m = 0; m < models.rows(); ++m) {
        const float* map = models.data() + m * size;
        const double its = dot(map, map, size) - even;
        const double both = std::max(dot(ranks.data(), map, size) - even, 0.0);
        correlations[m] = std::min(own, its) <= flat ? 0.0 : std::min(both / std::sqrt(own * its), 1.0);
    }
    return {std::move(ranks), std::move(correlations)};
}

}  // namespace tricue
