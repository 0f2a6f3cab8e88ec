// SPDX-License-Identifier: MIT
#pragma once
// How particles are drawn: arguments that several kernels share. They hold views of the caller's arrays.

#include "arrays.hpp"
#include "fuse/propose.hpp"
#include "tuples.hpp"

namespace tricue::bindings {

using DynamicsTuple = Tuple<Array<double>, Array<double>>;
using DetectionTuple = Tuple<Array<double>, Array<double>, double>;
using BoundsTuple = Tuple<Array<double>, Array<double>>;

inline Dynamics dynamics_of(const DynamicsTuple& dynamics) {
    const auto [drift, scale] = unpack(dynamics, "dynamics");
    return {vector(drift, "drift"), vector(scale, "scale")};
}

inline Detection detection_of(const DetectionTuple& detection) {
    const auto [mean, root, share] = unpack(detection, "detection");
    return {vector(mean, "mean"), states(root, "root"), share};
}

inline Bounds bounds_of(const BoundsTuple& bounds) {
    const auto [lower, upper] = unpack(bounds, "bounds");
    return {vector(lower, "lower"), vector(upper, "upper")};
}

}  // namespace tricue::bindings
