// SPDX-License-Identifier: MIT
#include "fuse/rectangle_prior.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

TRICUE_INLINE double as_double(std::uint64_t bits) {
    double number;
    std::memcpy(&number, &bits, sizeof number);
    return number;
}

/// Logarithms of normal numbers above 0, within a few ulp, in place: a loop that is vectorized, as std::log isn't.
///     x = 2^k (1 + f), 1 + f in [sqrt(1/2), sqrt(2)),  log(1 + f) = 2 artanh(s) = 2 (s + s³/3 + s⁵/5 + ...),  s = f / (2 + f)
/// The terms from s²¹ on are below half an ulp, as s² < 0.0295.
TRICUE_MULTIVERSION
void take_logs(double* __restrict numbers, std::ptrdiff_t n) {
    constexpr std::uint64_t kOne = 0x3FF0000000000000, kRoot = 0x3FE6A09E00000000,  // 1, sqrt(1/2)
        kMantissa = 0xFFFFFFFFFFFFF, kTwo52 = 0x4330000000000000;
    constexpr double kLog2 = 0.69314718055994530942;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        std::uint64_t bits;
        std::memcpy(&bits, numbers + i, sizeof bits);
        const std::uint64_t from_root = bits + (kOne - kRoot);
        // A whole number in the last bits of 2^52 + it: a conversion that all levels of x86-64 vectorize.
        const double k = as_double(kTwo52 | from_root >> 52) - (4503599627370496.0 + 1023.0);
        const double f = as_double((from_root & kMantissa) + kRoot) - 1.0;
        const double s = f / (2.0 + f), z = s * s;
        double tail = 1.0 / 19.0;
        for (const double term :
             {1.0 / 17.0, 1.0 / 15.0, 1.0 / 13.0, 1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0})
            tail = term + z * tail;
        numbers[i] = k * kLog2 + (2.0 * s + 2.0 * s * z * tail);
    }
}

/// Adds the squares of (x - middle) / deviation.
TRICUE_MULTIVERSION
void add_squares(const double* __restrict x, std::ptrdiff_t n, double middle, double deviation,
                 double* __restrict sums) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const double off = (x[i] - middle) / deviation;
        sums[i] += off * off;
    }
}

/// One column of the states after the other, so that all of them are computed at once.
Vector log_sizes(StatesRef states, const MeanSize& mean_size) {
    constexpr double kMinNormal = std::numeric_limits<double>::min(),
                     kMaxFinite = std::numeric_limits<double>::max();
    const Index n = states.rows(), first = states.cols() - 2;
    Vector sums = Vector::Zero(n), relative(n);
    for (Index i = 0; i < 2; ++i) {
        relative = states.col(first + i) / mean_size.size[i];
        if ((relative >= kMinNormal && relative <= kMaxFinite).all())
            take_logs(relative.data(), n);
        else
            for (double& each : relative) each = std::log(each);
        add_squares(relative.data(), n, 0.0, mean_size.spread[i], sums.data());
    }
    return -0.5 * sums;
}

Vector log_measured(StatesRef states, const MeasuredState& measured) {
    const Index n = states.rows();
    Vector sums = Vector::Zero(n), numbers(n);
    for (Index i = 0; i < measured.state.size(); ++i) {
        numbers = states.col(i);
        add_squares(numbers.data(), n, measured.state[i], measured.deviation[i], sums.data());
    }
    return -(0.5 * sums).min(measured.max_cost);
}

void require_positive(VectorRef values, const char* name) {
    for (const double value : values)
        if (!(value > 0.0)) refuse(name, "numbers above 0", value);
}

void require_arguments(StatesRef states, const MeanSize& mean_size, const MeasuredState& measured) {
    const Index D = states.cols();
    if (D < 2) refuse("states", "2 columns or more", std::to_string(D));
    require_finite(states, "states");
    for (Index i = 0; i < states.rows(); ++i)
        for (Index j = D - 2; j < D; ++j)
            if (!(states(i, j) > 0.0)) refuse("states", "sizes above 0", states(i, j));
    for (const auto& [values, name] :
         {std::pair{mean_size.size, "size"}, std::pair{mean_size.spread, "spread"}}) {
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

Vector rectangle_prior(StatesRef states, const MeanSize& mean_size, const MeasuredState& measured) {
    require_arguments(states, mean_size, measured);
    return log_sizes(states, mean_size) + log_measured(states, measured);
}

}  // namespace tricue
