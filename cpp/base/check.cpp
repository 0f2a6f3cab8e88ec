// SPDX-License-Identifier: MIT
#include "base/check.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION bool all_finite(const double* values, Eigen::Index count) {
    long long invalid = 0;
    for (Eigen::Index i = 0; i < count; ++i)
        invalid += !(std::abs(values[i]) <= std::numeric_limits<double>::max());
    return invalid == 0;
}

void require_finite(const double* values, Eigen::Index count, const char* name) {
    if (all_finite(values, count)) return;
    while (std::isfinite(*values)) ++values;
    refuse(name, "finite numbers", *values);
}

}  // namespace

std::string shape_text(Eigen::Index rows, Eigen::Index cols) {
    return "(" + std::to_string(rows) + ", " + std::to_string(cols) + ")";
}

void refuse(const char* name, const std::string& expected, const std::string& got) {
    throw std::invalid_argument(std::string(name) + ": expected " + expected + ", got " + got);
}

void refuse(const char* name, const std::string& expected, double got) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", got);
    refuse(name, expected,
           std::isnan(got) ? std::string("nan") : std::string(text));  // whatever its sign bit
}

void require_positive(double value, const char* name) {
    if (!(value > 0.0 && std::isfinite(value))) refuse(name, "a finite number above 0", value);
}

void require_not_negative(double value, const char* name) {
    if (!(value >= 0.0 && std::isfinite(value))) refuse(name, "a finite number, not negative", value);
}

void require_share(double share) {
    if (!(share >= 0.0 && share < 1.0)) refuse("share", "a number in [0, 1)", share);
}

void require_count(int count, int least, int most, const char* name) {
    if (count < least || count > most)
        refuse(name, std::to_string(least) + " to " + std::to_string(most), count);
}

void require_rows(Eigen::Index rows, Eigen::Index count, const char* name) {
    if (rows != count) refuse(name, std::to_string(count) + " rows", std::to_string(rows));
}

void require_size(VectorRef values, Eigen::Index size, const char* name) {
    if (values.size() != size)
        refuse(name, "shape (" + std::to_string(size) + ",)", "(" + std::to_string(values.size()) + ",)");
}

void require_shape(Eigen::Index rows, Eigen::Index cols, Eigen::Index expected_rows,
                   Eigen::Index expected_cols, const char* name) {
    if (rows != expected_rows || cols != expected_cols)
        refuse(name, "shape " + shape_text(expected_rows, expected_cols), shape_text(rows, cols));
}

void require_shape(StatesRef values, Eigen::Index rows, Eigen::Index cols, const char* name) {
    require_shape(values.rows(), values.cols(), rows, cols, name);
}

void require_region(const Region& region, int rows, int cols) {
    const auto [x0, y0, x1, y1] = region;
    if (0 <= x0 && x0 <= x1 && x1 <= cols && 0 <= y0 && y0 <= y1 && y1 <= rows) return;
    const auto text = [](int number) { return std::to_string(number); };
    refuse("region", "x0, y0, x1, y1 in order, within " + text(cols) + " x " + text(rows),
           "(" + text(x0) + ", " + text(y0) + ", " + text(x1) + ", " + text(y1) + ")");
}

void require_finite(VectorRef values, const char* name) {
    require_finite(values.data(), values.size(), name);
}

void require_finite(StatesRef values, const char* name) {
    require_finite(values.data(), values.size(), name);
}

void require_covariance(StatesRef values, Eigen::Index size, const char* name) {
    require_shape(values, size, size, name);
    require_finite(values, name);
    if (size == 0) return;
    const auto variances = values.matrix().diagonal().array();
    if (variances.minCoeff() < 0.0) refuse(name, "no negative variance", variances.minCoeff());
    const double skew = (values - values.transpose()).abs().maxCoeff();
    if (skew > 1e-9 * variances.maxCoeff())
        refuse(name, "a symmetric matrix", "entries that differ by " + std::to_string(skew));
}

double require_weights(VectorRef weights) {
    double total = 0.0;
    for (const double weight : weights) {
        if (!(weight >= 0.0 && std::isfinite(weight)))
            refuse("weights", "finite numbers, none negative", weight);
        total += weight;
    }
    if (!(total > 0.0 && std::isfinite(total))) refuse("weights", "a finite sum above 0", total);
    return total;
}

}  // namespace tricue
