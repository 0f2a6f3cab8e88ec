// SPDX-License-Identifier: MIT
#include "fuse/target_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/check.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr double kRelativeTolerance = 1e-9;  // of the peak: values that differ by less are equal
constexpr Index kNone = -1;

struct Peak {
    double at;  ///< in bins from the middle of the first
    Index bin;  ///< the bin that contains the peak
};

void require_arguments(VectorRef histogram, double smoothing, double min_prominence, double expected,
                       double spread) {
    if (histogram.size() < 1) refuse("histogram", "at least one bin", "none");
    for (const double value : histogram)
        if (!(value >= 0.0 && std::isfinite(value)))
            refuse("histogram", "finite numbers, none negative", value);
    if (!(smoothing >= 0.0 && smoothing <= static_cast<double>(histogram.size())))
        refuse("smoothing", "a number in [0, " + std::to_string(histogram.size()) + "]", smoothing);
    if (!(min_prominence >= 0.0 && min_prominence < 1.0))
        refuse("min_prominence", "a number in [0, 1)", min_prominence);
    if (std::isinf(expected)) refuse("expected", "a finite number or NaN", expected);
    if (!(spread > 0.0)) refuse("spread", "a number above 0", spread);
}

/// Both sides are added to each other first, so that a mirrored histogram gives the mirrored result, bit for bit.
void add_symmetric_tap(const Vector& values, Index j, double weight, Vector& total, Vector& weights) {
    const Index count = values.size();
    for (Index i = 0; i < count; ++i) {
        const bool left = i >= j, right = i < count - j;
        total[i] += weight * ((left ? values[i - j] : 0.0) + (right ? values[i + j] : 0.0));
        weights[i] += weight * static_cast<double>(int{left} + int{right});
    }
}

Vector smoothed(const Vector& histogram, double smoothing) {
    Vector total = histogram, weights = Vector::Ones(histogram.size());
    const auto radius = static_cast<Index>(std::ceil(4.0 * smoothing));
    for (Index j = 1; j <= std::min(radius, histogram.size() - 1); ++j) {
        const double step = static_cast<double>(j) / smoothing;
        add_symmetric_tap(histogram, j, std::exp(-0.5 * (step * step)), total, weights);
    }
    return total / weights;
}

double center_of(Index bin) {
    return static_cast<double>(bin) + 0.5;
}

/// The center of the nearest bin that isn't empty. An expected peak outside the range counts as at its end.
double nearest_center(const Vector& smooth, double expected) {
    const double within = std::clamp(expected, 0.0, static_cast<double>(smooth.size()));
    double nearest = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < smooth.size(); ++i) {
        const double center = center_of(i);
        if (smooth[i] > 0.0 && std::abs(center - within) < std::abs(nearest - within)) nearest = center;
    }
    return nearest;
}

/// The values times the Gaussian around the expected peak, relative to its value at the nearest center.
Vector weighted(const Vector& smooth, double expected, double spread) {
    const double nearest = nearest_center(smooth, expected);
    Vector values = smooth;
    for (Index i = 0; i < smooth.size(); ++i) {
        const double center = center_of(i);
        // ((center - expected)² - (nearest - expected)²) / 2, without the squares, which would overflow.
        const double farther = (center - nearest) * ((center + nearest) / 2.0 - expected);
        values[i] *= std::exp(-std::max(farther, 0.0) / spread / spread);
    }
    return values;
}

/// The first maximum, in the middle of a plateau.
Peak find_peak(const Vector& values) {
    const double top = values.maxCoeff(), high = top - kRelativeTolerance * top;
    Index begin = 0;
    while (values[begin] < high) ++begin;
    Index end = begin;
    while (end + 1 < values.size() && values[end + 1] >= high) ++end;
    if (end > begin || begin == 0 || end == values.size() - 1)
        return {static_cast<double>(begin + end) / 2.0, (begin + end + 1) / 2};
    const double before = values[begin - 1], at = values[begin], after = values[begin + 1];
    return {static_cast<double>(begin) + (before - after) / (2.0 * (before - 2.0 * at + after)), begin};
}

/// The minimum on one side of the peak, from bin `first` by steps of 1 or -1; kNone without.
Index find_minimum(const Vector& smooth, Index first, Index step, double equal, double rise) {
    Index least = first;
    for (Index i = first; i >= 0 && i < smooth.size(); i += step) {
        if (smooth[i] < smooth[least] - equal)
            least = i;
        else if (smooth[i] > smooth[least] + rise)
            return least;
    }
    return kNone;
}

/// Replaces the density beyond the minimum by the line through the peak and the minimum, or by 0 if the minimum is the peak.
void extend_line(const Vector& smooth, const Peak& peak, Index minimum, Index step, Vector& density) {
    const double height = smooth[peak.bin];
    const bool shoulder = minimum == peak.bin;
    const double run = static_cast<double>(minimum) - peak.at;
    const double slope = shoulder ? 0.0 : (smooth[minimum] - height) / run;
    for (Index i = minimum + step; i >= 0 && i < smooth.size(); i += step) {
        const double line = height + slope * (static_cast<double>(i) - peak.at);
        density[i] = shoulder ? 0.0 : std::max(line, 0.0);
    }
}

}  // namespace

TargetDistribution target_distribution(VectorRef histogram, double smoothing, double min_prominence,
                                       double expected, double spread) {
    require_arguments(histogram, smoothing, min_prominence, expected, spread);
    const double most = histogram.maxCoeff();
    if (most == 0.0) return {Vector::Zero(histogram.size()), std::numeric_limits<double>::quiet_NaN()};
    const Vector smooth = smoothed(histogram / most, smoothing);
    const bool anywhere = std::isnan(expected) || std::isinf(spread);
    const Peak peak = find_peak(anywhere ? smooth : weighted(smooth, expected, spread));
    const double height = smooth[peak.bin];
    const double equal = kRelativeTolerance * height,
                 rise = std::max(min_prominence, kRelativeTolerance) * height;
    Vector density = smooth;
    for (const Index step : {Index{-1}, Index{1}}) {
        const Index minimum = find_minimum(smooth, peak.bin, step, equal, rise);
        if (minimum != kNone) extend_line(smooth, peak, minimum, step, density);
    }
    return {density / density.sum(), peak.at + 0.5};
}

}  // namespace tricue
