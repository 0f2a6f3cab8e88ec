// SPDX-License-Identifier: MIT
#include "cues/depth/density_extrema.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

/// The minimum between a peak and the next higher density in one direction; 0 if there is none higher.
double find_base(VectorRef density, Index peak, Index step) {
    double least = density[peak];
    for (Index i = peak; i >= 0 && i < density.size(); i += step) {
        if (density[i] > density[peak]) return least;
        least = std::min(least, density[i]);
    }
    return 0.0;
}

double prominence_of(VectorRef density, Index peak) {
    return density[peak] - std::max(find_base(density, peak, -1), find_base(density, peak, 1));
}

std::vector<Index> find_maxima(VectorRef density, double prominence) {
    std::vector<Index> maxima;
    const Index levels = density.size();
    for (Index begin = 0, end = 0; begin < levels; begin = end) {
        while (end < levels && density[end] == density[begin]) ++end;
        const double before = begin > 0 ? density[begin - 1] : 0.0;
        const double after = end < levels ? density[end] : 0.0;
        const bool peak = density[begin] > std::max(before, after);
        if (peak && prominence_of(density, begin) >= prominence) maxima.push_back((begin + end - 1) / 2);
    }
    return maxima;
}

Index find_minimum(VectorRef density, Index after, Index before) {
    const double* first = density.data() + after + 1;
    return std::min_element(first, density.data() + before) - density.data();
}

}  // namespace

Extrema density_extrema(VectorRef density, double prominence) {
    for (const double value : density)
        if (!(value >= 0.0 && std::isfinite(value)))
            refuse("density", "finite numbers, none negative", value);
    if (!(prominence >= 0.0)) refuse("prominence", "a number of at least 0", prominence);

    const auto maxima = find_maxima(density, prominence);
    const auto count = static_cast<Index>(maxima.size());
    Extrema extrema{Indices(count), Indices(std::max<Index>(count - 1, 0))};
    std::copy(maxima.begin(), maxima.end(), extrema.maxima.begin());
    for (Index j = 0; j + 1 < count; ++j)
        extrema.minima[j] = find_minimum(density, extrema.maxima[j], extrema.maxima[j + 1]);
    return extrema;
}

}  // namespace tricue
