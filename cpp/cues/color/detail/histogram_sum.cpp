// SPDX-License-Identifier: MIT
#include "cues/color/detail/histogram_sum.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

struct Total {
    double sum;
    bool valid;
};

/// In eight sums, so that it vectorizes in a fixed order.
TRICUE_MULTIVERSION
Total add(const double* numbers, Eigen::Index n) {
    constexpr Eigen::Index kSums = 8;
    double sums[kSums] = {};
    int invalid = 0;
    for (Eigen::Index i = 0; i + kSums <= n; i += kSums)
        for (Eigen::Index k = 0; k < kSums; ++k) {
            sums[k] += numbers[i + k];
            invalid += !(numbers[i + k] >= 0.0);
        }
    for (Eigen::Index i = n / kSums * kSums; i < n; ++i) {
        sums[0] += numbers[i];
        invalid += !(numbers[i] >= 0.0);
    }
    double sum = 0.0;
    for (const double part : sums) sum += part;
    return {sum, invalid == 0};
}

}  // namespace

double require_histogram_sum(VectorRef histogram, const char* name) {
    if (histogram.size() == 0) refuse(name, "at least one bin", "none");
    const Total total = add(histogram.data(), histogram.size());
    if (total.valid && total.sum > 0.0 && std::isfinite(total.sum)) return total.sum;
    require_finite(histogram, name);
    if (!total.valid) refuse(name, "no negative number", histogram.minCoeff());
    refuse(name, "a finite sum above 0", total.sum);
}

}  // namespace tricue
