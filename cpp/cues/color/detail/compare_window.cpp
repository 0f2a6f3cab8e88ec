// SPDX-License-Identifier: MIT
#include "cues/color/detail/compare_window.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/color_ranks.hpp"

namespace tricue {
namespace {

/// a·a, a·b and b·b.
struct Products {
    double aa, ab, bb;
};

/// Each as four sums, so that an addition needn't wait for the previous one.
TRICUE_MULTIVERSION
void multiply(const float* a, const float* b, std::ptrdiff_t n, Products* products) {
    using Lanes = Pack<double, 4>;
    Lanes aa = {}, ab = {}, bb = {};
    std::ptrdiff_t k = 0;
    for (; k + 4 <= n; k += 4) {
        Pack<float, 4> four;
        Lanes left, right;
        load(a + k, four);
        convert(four, left);
        load(b + k, four);
        convert(four, right);
        aa += left * left;
        ab += left * right;
        bb += right * right;
    }
    for (; k < n; ++k) {
        const auto left = static_cast<double>(a[k]), right = static_cast<double>(b[k]);
        aa[0] += left * left;
        ab[0] += left * right;
        bb[0] += right * right;
    }
    *products = {sum(aa), sum(ab), sum(bb)};
}

}  // namespace

RankWindow compare_window(const std::uint8_t* planes, std::ptrdiff_t n, FloatsRef models, double flat) {
    if (!(flat >= 0.0)) refuse("flat", "a number from 0", flat);
    Floats ranks = color_ranks({planes, 1, n});
    const std::ptrdiff_t size = 3 * n;
    const double even = static_cast<double>(size) / 4.0;
    Vector correlations(models.rows());
    for (Eigen::Index m = 0; m < models.rows(); ++m) {
        Products products;
        multiply(ranks.data(), models.data() + m * size, size, &products);
        const double own = products.aa - even, its = products.bb - even;
        const double both = std::max(products.ab - even, 0.0);
        correlations[m] = std::min(own, its) <= flat ? 0.0 : std::min(both / std::sqrt(own * its), 1.0);
    }
    return {std::move(ranks), std::move(correlations)};
}

}  // namespace tricue
