// SPDX-License-Identifier: MIT
#include "camera/back_project.hpp"

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"

namespace tricue {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Matrix3Ref = Eigen::Map<const Matrix3>;

void require_variances(StatesRef variances, Eigen::Index count) {
    if (variances.cols() == 3) {
        require_shape(variances, 1, 3, "variances");
        require_covariance(Matrix3(variances.matrix().row(0).asDiagonal()).array(), 3, "variances");
        return;
    }
    if (variances.rows() != count)
        refuse("variances", "one covariance for each of " + std::to_string(count) + " measurements",
               std::to_string(variances.rows()));
    require_shape(variances, count, 9, "variances");
    for (Eigen::Index i = 0; i < count; ++i)
        require_covariance(Matrix3Ref(variances.row(i).data()).array(), 3, "variances");
}

}  // namespace

BackProjection back_project(StatesRef measurements, StatesRef variances, VectorRef camera, double baseline) {
    const Eigen::Index count = measurements.rows();
    require_shape(measurements, count, 3, "measurements");
    require_variances(variances, count);
    require_camera(camera);
    require_positive(baseline, "baseline");

    const bool shared = variances.cols() == 3;
    const double fx = camera[0], fy = camera[1], cx = camera[2], cy = camera[3];
    const Matrix3 same = shared ? Matrix3(variances.matrix().row(0).asDiagonal()) : Matrix3::Zero();
    BackProjection result{States(count, 3), States(count, 9)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const double u = measurements(i, 0), v = measurements(i, 1), d = measurements(i, 2);
        if (!(d > 0.0 && std::isfinite(u) && std::isfinite(v) && std::isfinite(d))) {
            result.points.row(i) = std::numeric_limits<double>::quiet_NaN();
            result.covariances.row(i) = std::numeric_limits<double>::quiet_NaN();
            continue;
        }
        const double z = fx * baseline / d, x = (u - cx) * z / fx, y = (v - cy) * z / fy;
        result.points.row(i) << x, y, z;
        Matrix3 jacobian;  // of x, y, z with respect to u, v, d
        jacobian << z / fx, 0.0, -x / d, 0.0, z / fy, -y / d, 0.0, 0.0, -z / d;
        const Matrix3 noise = shared ? same : Matrix3(Matrix3Ref(variances.row(i).data()));
        const Matrix3 covariance = jacobian * noise * jacobian.transpose();
        Eigen::Map<Matrix3>(result.covariances.row(i).data()) = (covariance + covariance.transpose()) / 2.0;
    }
    return result;
}

}  // namespace tricue
