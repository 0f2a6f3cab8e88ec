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

    return with_matrix_type(mean.size(), [&](auto empty) -> Belief {
        using Matrix = decltype(empty);
        const Matrix f = transition.matrix(), p = covariance.matrix();
        const Matrix moved = product(product(f, p), f.transpose());
        return {f.lazyProduct(mean.matrix()).array(), symmetrized(moved + noise.matrix())};
    });
}

}  // namespace tricue
