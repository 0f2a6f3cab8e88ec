// SPDX-License-Identifier: MIT
#include "cues/motion/flow_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "base/arrays.hpp"
#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kLanes = 4;  // sums side by side, so that an addition needn't wait for the one before
using Doubles4 = Pack<double, kLanes>;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr float kMaxFloat = std::numeric_limits<float>::max();

/// The flow in rows that are filled up to whole fours. `counts` is 1 where a pixel counts; elsewhere it, u and v are 0.
struct Field {
    explicit Field(const PlaneView& plane)
        : rows(plane.rows),
          cols((plane.cols + kLanes - 1) / kLanes * kLanes),
          middle_x((plane.cols - 1) / 2.0),
          middle_y((plane.rows - 1) / 2.0),
          planes(4, Eigen::Index{rows} * cols) {}

    double* counts() { return planes.data(); }
    double* u() { return counts() + planes.cols(); }
    double* v() { return u() + planes.cols(); }
    double* squares() { return v() + planes.cols(); }  ///< of the residuals, pixels²

    int rows, cols;
    double middle_x, middle_y;
    States planes;
};

/// Flow that stretches: u = s x + u0, v = s y + v0.
struct Expansion {
    double s, u0, v0;
};

/// Of the pixels that count.
struct Sums {
    double count, x, y, u, v, places, products;  ///< places x² + y², products x u + y v
};

TRICUE_MULTIVERSION
void copy_row(const float* __restrict u, const float* __restrict v, int n, double* __restrict counts,
              double* __restrict us, double* __restrict vs) {
    for (int x = 0; x < n; ++x) {
        const bool known = (std::abs(u[x]) <= kMaxFloat) & (std::abs(v[x]) <= kMaxFloat);
        counts[x] = known ? 1.0 : 0.0;
        us[x] = static_cast<double>(known ? u[x] : 0.0F);
        vs[x] = static_cast<double>(known ? v[x] : 0.0F);
    }
}

void copy(const PlaneView& u, const PlaneView& v, Field& field) {
    for (int y = 0; y < u.rows; ++y) {
        const std::ptrdiff_t begin = std::ptrdiff_t{y} * field.cols;
        copy_row(u.row(y), v.row(y), u.cols, field.counts() + begin, field.u() + begin, field.v() + begin);
        for (double* plane : {field.counts(), field.u(), field.v()})
            std::fill(plane + begin + u.cols, plane + begin + field.cols, 0.0);
    }
}

TRICUE_MULTIVERSION
void accumulate(Field& field, Sums& sums) {
    const int rows = field.rows, cols = field.cols;
    const double *ones = field.counts(), *us = field.u(), *vs = field.v();
    Doubles4 count = {}, across = {}, down = {}, right = {}, low = {}, places = {}, products = {};
    for (int row = 0; row < rows; ++row, ones += cols, us += cols, vs += cols) {
        const double y = row - field.middle_y;
        Doubles4 x = Doubles4{0, 1, 2, 3} - field.middle_x;
        for (int i = 0; i < cols; i += kLanes, x += kLanes) {
            Doubles4 one, u, v;
            load(ones + i, one);
            load(us + i, u);
            load(vs + i, v);
            count += one;
            across += one * x;
            down += one * y;
            right += u;
            low += v;
            places += one * (x * x + y * y);
            products += x * u + y * v;
        }
    }
    sums = {sum(count), sum(across), sum(down), sum(right), sum(low), sum(places), sum(products)};
}

/// Sets the squares, and gives the sum of those that count.
TRICUE_MULTIVERSION
double sum_squares(Field& field, const Expansion& expansion) {
    const int rows = field.rows, cols = field.cols;
    const auto [s, u0, v0] = expansion;
    const double *ones = field.counts(), *us = field.u(), *vs = field.v();
    double* squares = field.squares();
    Doubles4 total = {};
    for (int row = 0; row < rows; ++row, ones += cols, us += cols, vs += cols, squares += cols) {
        const double y = row - field.middle_y;
        Doubles4 x = Doubles4{0, 1, 2, 3} - field.middle_x;
        for (int i = 0; i < cols; i += kLanes, x += kLanes) {
            Doubles4 one, u, v;
            load(ones + i, one);
            load(us + i, u);
            load(vs + i, v);
            u = u - s * x - u0;
            v = v - s * y - v0;
            const Doubles4 square = u * u + v * v;
            total += one * square;
            store(square, squares + i);
        }
    }
    return sum(total);
}

/// Pixels whose square is above the limit count no longer.
TRICUE_MULTIVERSION
void drop_outliers(const double* __restrict squares, std::ptrdiff_t n, double limit,
                   double* __restrict counts, double* __restrict u, double* __restrict v) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const bool kept = squares[i] <= limit;
        counts[i] = kept ? counts[i] : 0.0;
        u[i] = kept ? u[i] : 0.0;
        v[i] = kept ? v[i] : 0.0;
    }
}

/// The expansion, and what there is to tell of it; a is NaN where there is none.
FlowScale fit_expansion(Field& field, int least, Expansion& expansion) {
    Sums sums;
    accumulate(field, sums);
    const double n = sums.count;
    const auto count = static_cast<std::int64_t>(n);
    if (count < least) return {kUnknown, kUnknown, count};
    const double places = sums.places - (sums.x * sums.x + sums.y * sums.y) / n;
    if (!(places > 0)) return {kUnknown, kUnknown, count};
    const double s = (sums.products - (sums.x * sums.u + sums.y * sums.v) / n) / places;
    expansion = {s, (sums.u - s * sums.x) / n, (sums.v - s * sums.y) / n};
    return {1 - s, sum_squares(field, expansion) / n, count};
}

std::string shape(const PlaneView& plane) {
    return "(" + std::to_string(plane.rows) + ", " + std::to_string(plane.cols) + ")";
}

}  // namespace

FlowScale flow_scale(const PlaneView& u, const PlaneView& v, double outliers, int least) {
    if (u.rows != v.rows || u.cols != v.cols) refuse("v", "u's shape " + shape(u), shape(v));
    if (!(outliers > 0 && std::isfinite(outliers))) refuse("outliers", "a finite number above 0", outliers);
    if (least < 1) refuse("min_pixels", "at least 1 pixel", least);
    Field field(u);
    copy(u, v, field);
    Expansion expansion;
    const FlowScale first = fit_expansion(field, least, expansion);
    if (std::isnan(first.a)) return first;
    const double limit = outliers * (outliers * first.spread);  // in this order never infinity times 0
    drop_outliers(field.squares(), field.planes.cols(), limit, field.counts(), field.u(), field.v());
    return fit_expansion(field, least, expansion);
}

}  // namespace tricue
