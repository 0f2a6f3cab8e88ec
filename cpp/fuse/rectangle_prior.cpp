// SPDX-License-Identifier: MIT
#include "fuse/rectangle_prior.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/check.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

double square(double x) {
    return x * x;
}

double log_size(const double* size, const MeanSize& mean) {
    double sum = 0.0;
    for (Index i = 0; i < 2; ++i) sum += square(std::log(size[i] / mean.size[i]) / mean.spread[i]);
    return -0.5 * sum;
}

double log_measured(const double* state, const MeasuredState& measured) {
    double sum = 0.0;
    for (Index i = 0; i < measured.state.size(); ++i)
        sum += square((state[i] - measured.state[i]) / measured.deviation[i]);
    return -std::min(0.5 * sum, measured.max_cost);
}

void require_positive(VectorRef values, const char* name) {
    for (const double value : values)
        if (!(value > 0.0)) refuse(name, "numbers above 0", value);
}

void require_arguments(StatesRef states, const MeanSize& mean, const MeasuredState& measured) {
    const Index D = states.cols();
    if (D < 2) refuse("states", "2 columns or more", std::to_string(D));
    require_finite(states, "states");
    for (Index i = 0; i < states.rows(); ++i)
        for (Index j = D - 2; j < D; ++j)
            if (!(states(i, j) > 0.0)) refuse("states", "sizes above 0", states(i, j));
    for (const auto& [values, name] : {std::pair{mean.size, "size"}, std::pair{mean.spread, "spread"}}) {
        require_size(values, 2, name);
        require_finite(values, name);
        require_positive(values, name);
    }
    require_size(measured.state, D, "state");
    require_finite(measured.state, "state");
    require_size(measured.deviation, D, "deviation");
    require_positive(measured.deviation, "deviation");
    if (!(measured.max_cost >= 0.0)) refuse("max_cost", "a number of at least 0", measured.max_cost);
}

}  // namespace

Vector rectangle_prior(StatesRef states, const MeanSize& mean, const MeasuredState& measured) {
    require_arguments(states, mean, measured);
    Vector log_likelihood(states.rows());
    for (Index i = 0; i < states.rows(); ++i) {
        const double* state = states.row(i).data();
        log_likelihood[i] = log_size(state + states.cols() - 2, mean) + log_measured(state, measured);
    }
    return log_likelihood;
}

}  // namespace tricue
