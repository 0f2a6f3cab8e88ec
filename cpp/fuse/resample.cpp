// SPDX-License-Identifier: MIT
#include "fuse/resample.hpp"

#include <cmath>
#include <stdexcept>

namespace tricue {

Indices resample(VectorRef weights, double offset) {
    if (!(offset >= 0.0 && offset < 1.0)) throw std::invalid_argument("offset: expected a number in [0, 1)");
    const Eigen::Index n = weights.size();
    double total = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        if (!(weights[i] >= 0.0) || !std::isfinite(weights[i]))
            throw std::invalid_argument("weights: expected finite numbers, none negative");
        total += weights[i];
    }
    if (!(total > 0.0)) throw std::invalid_argument("weights: expected at least one above zero");

    Indices chosen(n);
    const double step = total / static_cast<double>(n);
    double cumulative = weights[0];
    Eigen::Index source = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double tooth = (static_cast<double>(i) + offset) * step;
        // The last particle takes whatever rounding leaves above the total.
        while (cumulative <= tooth && source + 1 < n) cumulative += weights[++source];
        chosen[i] = source;
    }
    return chosen;
}

}  // namespace tricue
