// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "cues/color/color_bins.hpp"

namespace tricue::bindings {
namespace {

using Corners = std::tuple<int, int, int, int>;

Array<std::uint16_t> color_bins_arrays(const Array<std::uint8_t>& image, const Corners& region,
                                       const std::tuple<int, int, int>& bins, int chroma, int step) {
    const auto view = color_image(image, "image");
    const auto [x0, y0, x1, y1] = region;
    const Region corners{x0, y0, x1, y1};
    const auto [first, second, third] = bins;
    const ColorSpace space{{first, second, third}, chroma};
    const Region seen = corners.clipped(view);
    return give(unlocked(std::ptrdiff_t{seen.x1 - seen.x0} * (seen.y1 - seen.y0),
                         [&] { return color_bins(view, corners, space, step); }));
}

}  // namespace

void define_color_search(py::module_& m) {
    m.def("color_bins", color_bins_arrays, py::arg("image"), py::arg("region"), py::arg("bins"),
          py::arg("chroma"), py::arg("step"),
          "The bin of every step-th pixel of region (x0, y0, x1, y1) in the space (B - G, G - R, B + G + R), "
          "(H, W) uint16; 65535 outside the image.");
}

}  // namespace tricue::bindings
