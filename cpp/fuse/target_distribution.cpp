// SPDX-License-Identifier: MIT
#include "fuse/target_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "check.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr double kEqual = 1e-9;  // of the peak: what differs less is the same height
constexpr Index kNone = -1;

void require(VectorRef histogram, double smoothing, double ripple) {
    if (histogram.size() < 1) refuse("histogram", "at least one bin", "none");
    for (const double value : histogram)
        if (!(value >= 0.0 && std::isfinite(value)))
            refuse("histogram", "finite numbers, none negative", value);
    if (!(smoothing >= 0.0 && smoothing <= static_cast<double>(histogram.size())))
        refuse("smoothing", "a number in [0, " + std::to_string(histogram.size()) + "]", smoothing);
    if (!(ripple >= 0.0 && ripple < 1.0)) refuse("ripple", "a number in [0, 1)", ripple);
}

/// Either side is added to the other first, so that a mirrored histogram is smoothed to a mirrored one, to the last bit.
void add_beside(const Vector& values, Index j, double weight, Vector& total, Vector& weights) {
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
        add_beside(histogram, j, std::exp(-0.5 * (step * step)), total, weights);
    }
    return total / weights;
}

/// Where the first highest stretch is, bins; 0 is the middle of the first.
double find_peak(const Vector& smooth, double top) {
    const double high = top - kEqual * top;
    Index begin = 0;
    while (smooth[begin] < high) ++begin;
    Index end = begin;
    while (end + 1 < smooth.size() && smooth[end + 1] >= high) ++end;
    if (end > begin || begin == 0 || end == smooth.size() - 1) return static_cast<double>(begin + end) / 2.0;
    const double before = smooth[begin - 1], at = smooth[begin], after = smooth[begin + 1];
    return static_cast<double>(begin) + (before - after) / (2.0 * (before - 2.0 * at + after));
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

/// Beyond the minimum the line through the peak (at, top) and it.
void extend_line(const Vector& smooth, double at, double top, Index minimum, Index step, Vector& density) {
    const double slope = (smooth[minimum] - top) / (static_cast<double>(minimum) - at);
    for (Index i = minimum + step; i >= 0 && i < smooth.size(); i += step)
        density[i] = std::max(top + slope * (static_cast<double>(i) - at), 0.0);
}

}  // namespace

TargetDistribution target_distribution(VectorRef histogram, double smoothing, double ripple) {
    require(histogram, smoothing, ripple);
    const double most = histogram.maxCoeff();
    if (most == 0.0) return {Vector::Zero(histogram.size()), std::numeric_limits<double>::quiet_NaN()};
    const Vector smooth = smoothed(histogram / most, smoothing);
    const double top = smooth.maxCoeff(), at = find_peak(smooth, top);
    const double equal = kEqual * top, rise = std::max(ripple, kEqual) * top;
    Vector density = smooth;
    for (const Index step : {Index{-1}, Index{1}}) {
        const auto first = static_cast<Index>(step < 0 ? std::floor(at) : std::ceil(at));
        const Index minimum = find_minimum(smooth, first, step, equal, rise);
        if (minimum != kNone) extend_line(smooth, at, top, minimum, step, density);
    }
    return {density / density.sum(), at + 0.5};
}

}  // namespace tricue
