// SPDX-License-Identifier: MIT
#include "fuse/kalman_update.hpp"

#include <Eigen/Cholesky>
#include <limits>

#include "base/check.hpp"
#include "fuse/detail/gaussian_state.hpp"

namespace tricue {
namespace {

/// A pivot no larger than the rounding error of its own variance counts as 0, whatever the unit.
Eigen::LLT<Matrix> positive_root(const States& s) {
    Eigen::LLT<Matrix> root(s.matrix());
    const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(s.rows());
    const Vector pivots = root.matrixLLT().diagonal().array().square();
    const Vector variances = s.matrix().diagonal().array();
    if (root.info() != Eigen::Success || !(pivots > rounding * variances).all() || !s.isFinite().all())
        refuse("noise", "with the state's a positive definite innovation covariance", "one that isn't");
    return root;
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

    const Matrix h = observation.matrix(), r = noise.matrix();
    Vector innovation = (measurement.matrix() - h * mean.matrix()).array();
    Matrix p = covariance.matrix(), hp = h * p;
    States s = symmetrized(hp * h.transpose() + r);
    Eigen::LLT<Matrix> root = positive_root(s);
    const double distance = root.matrixL().solve(innovation.matrix()).norm();
    if (distance > max_distance) {
        const double ratio = distance / max_distance;
        p *= ratio * ratio;
        hp = h * p;
        s = symmetrized(hp * h.transpose() + r);
        root = positive_root(s);
    }
    const Matrix gain = root.solve(hp).transpose();  // K = P Hᵀ S⁻¹, P and S being symmetric
    const Matrix rest = Matrix::Identity(size, size) - gain * h;
    return {mean + (gain * innovation.matrix()).array(),
            symmetrized(rest * p * rest.transpose() + gain * r * gain.transpose()), std::move(innovation),
            std::move(s)};
}

}  // namespace tricue
