// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "cues/motion/gradient_flow.hpp"
#include "cues/motion/pyramid_flow.hpp"
#include "kernel_docs.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;
using Planes = std::tuple<Array<float>, Array<float>, Array<float>, Array<float>>;

std::ptrdiff_t work(const ImageView& frame, const std::optional<Region>& region) {
    return region ? work_in(*region) : std::ptrdiff_t{frame.rows} * frame.cols;
}

/// The four as arrays of their own on the same memory.
Planes give_planes(FlowPlanes&& flow) {
    const auto rows = static_cast<py::ssize_t>(flow.rows),
               cols = static_cast<py::ssize_t>(flow.planes.cols());
    const auto all = give(std::move(flow.planes), {4, rows, cols});
    const auto plane = [&](int i) { return Array<float>(all[py::int_(i)]); };
    return {plane(0), plane(1), plane(2), plane(3)};
}

Planes gradient_flow_arrays(const Bytes& previous, const Bytes& current, double sigma, double min_angle,
                            double min_contrast, const std::optional<RegionTuple>& corners) {
    const auto before = gray_image(previous, "previous"), now = gray_image(current, "current");
    const auto region = region_of(corners);
    return give_planes(unlocked(work(now, region), [&] {
        return gradient_flow(before, now, sigma, {min_angle, min_contrast}, region);
    }));
}

Planes pyramid_flow_arrays(const Bytes& previous, const Bytes& current, double sigma, int levels,
                           double min_angle, double min_contrast, const std::optional<RegionTuple>& corners,
                           int pool, double max_step) {
    const auto before = gray_image(previous, "previous"), now = gray_image(current, "current");
    const auto region = region_of(corners);
    return give_planes(unlocked(work(now, region), [&] {
        return pyramid_flow(before, now, sigma, {levels, pool, max_step}, {min_angle, min_contrast}, region);
    }));
}

}  // namespace

void define_motion(py::module_& m) {
    m.def("gradient_flow", gradient_flow_arrays, py::arg("previous"), py::arg("current"), py::arg("sigma"),
          py::arg("min_angle"), py::arg("min_contrast"), py::arg("region") = py::none(), docs::gradient_flow);
    m.def("pyramid_flow", pyramid_flow_arrays, py::arg("previous"), py::arg("current"), py::arg("sigma"),
          py::arg("levels"), py::arg("min_angle"), py::arg("min_contrast"), py::arg("region") = py::none(),
          py::arg("pool") = 3, py::arg("max_step") = 0.4, docs::pyramid_flow);
}

}  // namespace tricue::bindings
