// SPDX-License-Identifier: MIT
#include "fuse/resample.hpp"

#include "base/check.hpp"

namespace tricue {

Indices resample(VectorRef weights, double offset) {
    if (!(offset >= 0.0 && offset < 1.0)) refuse("offset", "a number in [0, 1)", offset);
    const double total = require_weights(weights);
    const Eigen::Index n = weights.size();
    const double step = total / static_cast<double>(n);

    // Positions that rounding puts beyond the total select the last particle with a weight.
    Eigen::Index last = n - 1;
    while (weights[last] == 0.0) --last;

    Indices chosen(n);
    double cumulative = weights[0];
    Eigen::Index source = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double tooth = (static_cast<double>(i) + offset) * step;
        while (cumulative <= tooth && source < last) cumulative += weights[++source];
        chosen[i] = source;
    }
    return chosen;
}

}  // namespace tricue
