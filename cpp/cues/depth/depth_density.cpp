// SPDX-License-Identifier: MIT
#include "cues/depth/depth_density.hpp"

#include <cmath>
#include <string>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

double require_histogram(VectorRef histogram) {
    if (histogram.size() < 1) refuse("histogram", "at least one level", "none");
    double total = 0.0;
    for (const double count : histogram) {
        if (!(count >= 0.0 && std::isfinite(count)))
            refuse("histogram", "finite numbers, none negative", count);
        total += count;
    }
    if (!std::isfinite(total)) refuse("histogram", "a finite sum", total);
    return total;
}

Vector gaussian(double bandwidth) {
    const auto radius = static_cast<Eigen::Index>(std::ceil(4.0 * bandwidth));
    Vector kernel(2 * radius + 1);
    for (Eigen::Index j = -radius; j <= radius; ++j) {
        const double step = static_cast<double>(j) / bandwidth;
        kernel[radius + j] = std::exp(-0.5 * step * step);
    }
    return kernel / kernel.sum();
}

/// The levels with `radius` more at each end, mirrored as often as needed.
Vector mirrored(const Vector& levels, Eigen::Index radius) {
    const Eigen::Index count = levels.size(), period = 2 * count;
    Vector longer(count + 2 * radius);
    longer.segment(radius, count) = levels;
    for (Eigen::Index i = 0; i < radius; ++i) {
        const Eigen::Index place = i % period;  // from the end; mirrored levels are periodic
        const Eigen::Index mirror = place < count ? place : period - 1 - place;
        longer[radius - 1 - i] = levels[mirror];
        longer[radius + count + i] = levels[count - 1 - mirror];
    }
    return longer;
}

TRICUE_MULTIVERSION
void convolve(const double* __restrict levels, const double* __restrict kernel, Eigen::Index taps,
              Eigen::Index count, double* __restrict density) {
    for (Eigen::Index j = 0; j < taps; ++j)
        for (Eigen::Index i = 0; i < count; ++i) density[i] += kernel[j] * levels[i + j];
}

}  // namespace

Vector depth_density(VectorRef histogram, double bandwidth) {
    const double total = require_histogram(histogram);
    const Eigen::Index count = histogram.size();
    if (!(bandwidth > 0.0 && bandwidth <= static_cast<double>(count)))
        refuse("bandwidth", "a number in (0, " + std::to_string(count) + "]", bandwidth);
    Vector density = Vector::Zero(count);
    if (total == 0.0) return density;
    const Vector kernel = gaussian(bandwidth);
    const Vector levels = mirrored(histogram / total, kernel.size() / 2);
    convolve(levels.data(), kernel.data(), kernel.size(), count, density.data());
    return density;
}

}  // namespace tricue
