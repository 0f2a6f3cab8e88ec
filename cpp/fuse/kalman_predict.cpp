// SPDX-License-Identifier: MIT
#include "fuse/kalman_predict.hpp"

#include "base/check.hpp"
#include "fuse/detail/gaussian_state.hpp"

namespace tricue {

Belief kalman_predict(VectorRef mean, StatesRef covariance, StatesRef transition, StatesRef noise) {
    require_gaussian_state(mean, covariance);
    require_shape(transition, mean.size(), mean.size(), "transition");
    require_finite(transition, "transition");
    require_covariance(noise, mean.size(), "noise");

    const Matrix f = transition.matrix();
    const Matrix p = covariance.matrix();
    return {(f * mean.matrix()).array(), symmetrized(f * p * f.transpose() + noise.matrix())};
}

}  // namespace tricue
