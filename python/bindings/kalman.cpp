// SPDX-License-Identifier: MIT
#include <limits>

#include "arrays.hpp"
#include "fuse/kalman_predict.hpp"
#include "fuse/kalman_update.hpp"
#include "kernel_docs.hpp"

namespace tricue::bindings {
namespace {

using Numbers = Array<double>;

std::tuple<Numbers, Numbers> kalman_predict_arrays(const Numbers& mean, const Numbers& covariance,
                                                   const Numbers& transition, const Numbers& noise) {
    const auto x = vector(mean, "mean");
    const auto p = states(covariance, "covariance"), f = states(transition, "transition");
    const auto q = states(noise, "noise");
    auto next = unlocked(f.size(), [&] { return kalman_predict(x, p, f, q); });
    return {give(std::move(next.mean)), give(std::move(next.covariance))};
}

std::tuple<Numbers, Numbers, Numbers, Numbers> kalman_update_arrays(
    const Numbers& mean, const Numbers& covariance, const Numbers& measurement, const Numbers& observation,
    const Numbers& noise, double max_distance) {
    const auto x = vector(mean, "mean"), z = vector(measurement, "measurement");
    const auto p = states(covariance, "covariance"), h = states(observation, "observation");
    const auto r = states(noise, "noise");
    auto result = unlocked(p.size(), [&] { return kalman_update(x, p, z, h, r, max_distance); });
    return {give(std::move(result.mean)), give(std::move(result.covariance)),
            give(std::move(result.innovation)), give(std::move(result.innovation_covariance))};
}

}  // namespace

void define_kalman(py::module_& m) {
    m.def("kalman_predict", kalman_predict_arrays, py::arg("mean"), py::arg("covariance"),
          py::arg("transition"), py::arg("noise"), docs::kalman_predict);
    m.def("kalman_update", kalman_update_arrays, py::arg("mean"), py::arg("covariance"),
          py::arg("measurement"), py::arg("observation"), py::arg("noise"),
          py::arg("max_distance") = std::numeric_limits<double>::infinity(), docs::kalman_update);
}

}  // namespace tricue::bindings
