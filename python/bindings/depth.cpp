// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/depth/height_above.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;

std::ptrdiff_t pixels(const DepthView& depth) {
    return std::ptrdiff_t{depth.rows} * depth.cols;
}

Array<float> height_above_arrays(const Array<float>& depth, const Array<double>& camera,
                                 const Array<double>& plane) {
    const auto view = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto floor = vector(plane, "plane");
    return give(unlocked(pixels(view), [&] { return height_above(view, lens, floor); }));
}

}  // namespace

void define_depth(py::module_& m) {
    m.def("height_above", height_above_arrays, py::arg("depth"), py::arg("camera"), py::arg("plane"),
          "Height n . X + d (H, W), metres, of every pixel above the plane (4,): nx, ny, nz, d; NaN where "
          "nothing was measured. camera (4,): fx, fy, cx, cy.");
}

}  // namespace tricue::bindings
