// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "cues/stereo/sad_disparity.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;
using Rectangle = std::tuple<int, int, int, int>;

Array<float> sad_disparity_arrays(const Bytes& left, const Bytes& right, const Rectangle& region,
                                  bool ellipse, int first, int last, int window, int uniqueness,
                                  bool prefilter, int tolerance) {
    const auto view = gray_image(left, "left"), other = gray_image(right, "right");
    const auto [x, y, width, height] = region;
    const StereoRegion part{x, y, width, height, ellipse};
    const StereoMatching matching{window, uniqueness, prefilter, tolerance};
    const auto work = std::ptrdiff_t{width} * height;  // negative sides raise anyway
    return give(unlocked(work, [&] { return sad_disparity(view, other, part, {first, last}, matching); }));
}

}  // namespace

void define_stereo(py::module_& m) {
    m.def("sad_disparity", sad_disparity_arrays, py::arg("left"), py::arg("right"), py::arg("region"),
          py::arg("ellipse"), py::arg("first"), py::arg("last"), py::arg("window") = 5,
          py::arg("uniqueness") = 15, py::arg("prefilter") = true, py::arg("tolerance") = -1,
          "Disparities (h, w), pixels, of the region (left, top, width, height) of the left of two rectified "
          "gray images (H, W), or of the ellipse in it, x_right = x_left - d, d in [first, last]: equations "
          "(3), (4); NaN where rejected or not seen. uniqueness in percent, 0 rejects nothing; tolerance of "
          "the "
          "left-right check in pixels, negative for none.");
}

}  // namespace tricue::bindings
