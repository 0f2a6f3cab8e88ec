// SPDX-License-Identifier: MIT
#include "fuse/kalman_update.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "base/check.hpp"
#include "fuse/detail/gaussian_state.hpp"

namespace tricue {
namespace {

/// A pivot no larger than the rounding error of its own variance counts as 0, whatever the unit.
template <typename Matrix>
Eigen::LLT<Matrix> positive_root(const Matrix& s) {
    Eigen::LLT<Matrix> root(s);
    const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(s.rows());
    bool positive = root.info() == Eigen::Success && s.array().isFinite().all();
    for (Eigen::Index i = 0; positive && i < s.rows(); ++i) {
        const double pivot = root.matrixLLT()(i, i);
        positive = pivot * pivot > rounding * s(i, i);
    }
    if (!positive)
        refuse("noise", "with the state's a positive definite innovation covariance", "one that isn't");
    return root;
}

/// The update of valid input.
template <typename Matrix>
Correction correct(VectorRef mean, StatesRef covariance, VectorRef measurement, StatesRef observation,
                   StatesRef noise, double max_distance) {
    const Matrix h = observation.matrix(), transposed_h = h.transpose(), r = noise.matrix();
    Vector innovation = measurement - h.lazyProduct(mean.matrix()).array();
    Matrix p = covariance.matrix(), hp = product(h, p);
    Matrix s = symmetrized(product(hp, transposed_h) + r).matrix();
    Eigen::LLT<Matrix> root = positive_root(s);
    const double distance = root.matrixL().solve(innovation.matrix()).norm();
    if (distance > max_distance) {
        const double ratio = distance / max_distance;
        p *= ratio * ratio;
        hp = product(h, p);
        s = symmetrized(product(hp, transposed_h) + r).matrix();
        root = positive_root(s);
    }
    const Matrix gain = root.solve(hp).transpose();  // K = P Hᵀ S⁻¹, P and S being symmetric
    Matrix rest = -product(gain, h);
    rest.diagonal().array() += 1.0;
    const Matrix squares =
        product(product(rest, p), rest.transpose()) + product(product(gain, r), gain.transpose());
    return {mean + gain.lazyProduct(innovation.matrix()).array(), symmetrized(squares), std::move(innovation),
            s.array()};
}

}  // namespace

Correction kalman_update(VectorRef mean, StatesRef covariance, VectorRef measurement, StatesRef observation,
                         StatesRef noise, double max_distance) {
    const Eigen::Index size = mean.size(), measured = measurement.size();
    require_gaussian_state(mean, covariance);
    if (measured < 1) refuse("measurement", "at least one number", "none");
    require_finite(measurement, "measurement");
    require_shape(observation, measured, size, "observation");
    require_finite(observation, "observation");
    require_covariance(noise, measured, "noise");

    if (!(max_distance > 0.0)) refuse("max_distance", "a number above 0", max_distance);

    return with_matrix_type(std::max(size, measured), [&](auto empty) {
        return correct<decltype(empty)>(mean, covariance, measurement, observation, noise, max_distance);
    });
}

}  // namespace tricue
