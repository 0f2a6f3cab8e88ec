// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/color/box_contrast.hpp"
#include "cues/color/color_posterior.hpp"
#include "cues/color/hog_color_cells.hpp"
#include "cues/color/pick_pixels.hpp"
#include "cues/color/sample_turned_windows.hpp"
#include "cues/color/sample_windows.hpp"
#include "kernel_docs.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;

Bytes sample_windows_arrays(const Bytes& image, const Array<double>& windows, int rows, int columns) {
    const auto view = any_image(image, "image");
    const auto each = states(windows, "windows");
    const auto work = work_of(each.rows(), rows, columns);
    auto samples = unlocked(work, [&] { return sample_windows(view, each, rows, columns); });
    if (view.channels == 1) return give(std::move(samples), {each.rows(), rows, columns});
    return give(std::move(samples), {each.rows(), rows, columns, 3});
}

Bytes sample_turned_windows_arrays(const Bytes& image, const Array<double>& windows, int rows, int columns) {
    const auto view = color_image(image, "image");
    const auto each = states(windows, "windows");
    const auto work = work_of(each.rows(), rows, columns);
    auto samples = unlocked(work, [&] { return sample_turned_windows(view, each, rows, columns); });
    return give(std::move(samples), {each.rows(), rows, columns, 3});
}

Array<float> hog_color_cells_arrays(const Bytes& patch, const Array<float>& taper) {
    const auto view = color_image(patch, "patch");
    const auto weights = floats(taper, "taper", {-1, -1}, "float32 (R, C)");
    auto cells = unlocked(std::ptrdiff_t{view.rows} * view.cols, [&] {
        const FloatPlanes planes = hog_color_cells(view, weights);
        Floats each(planes.planes(), planes.size());
        for (int k = 0; k < planes.planes(); ++k) std::copy_n(planes.plane(k), planes.size(), &each(k, 0));
        return each;
    });
    return give(std::move(cells), {cells.rows(), weights.rows(), weights.cols()});
}

Array<float> color_posterior_arrays(const Bytes& image, const Array<float>& table) {
    const auto view = color_image(image, "image");
    const auto each = color_cube(table);
    return give(unlocked(std::ptrdiff_t{view.rows} * view.cols, [&] { return color_posterior(view, each); }));
}

Bytes pick_pixels_arrays(const Bytes& image, const Array<std::int64_t>& places) {
    const auto view = color_image(image, "image");
    const auto array = require<std::int64_t>(places, "places", 2, "int64 (R, C)");
    const Eigen::Map<const PixelPlaces> each(contiguous<std::int64_t>(array, "places"), array.shape(0),
                                             array.shape(1));
    return give(unlocked(each.size(), [&] { return pick_pixels(view, each); }),
                {each.rows(), each.cols(), 3});
}

PlaneView map(const Array<float>& plane) {
    return plane_view(plane, "plane", "a float32 map (H, W)");
}

Array<float> box_contrast_arrays(const Array<float>& plane, double width, double height, double surround_size,
                                 double surround_weight) {
    const auto view = map(plane);
    return give(unlocked(std::ptrdiff_t{view.rows} * view.cols, [&] {
        return box_contrast(view, {width, height, surround_size}, surround_weight);
    }));
}

}  // namespace

void define_patch(py::module_& m) {
    m.def("sample_windows", sample_windows_arrays, py::arg("image"), py::arg("windows"), py::arg("rows"),
          py::arg("columns"), docs::sample_windows);
    m.def("sample_turned_windows", sample_turned_windows_arrays, py::arg("image"), py::arg("windows"),
          py::arg("rows"), py::arg("columns"), docs::sample_turned_windows);
    m.def("hog_color_cells", hog_color_cells_arrays, py::arg("patch"), py::arg("taper"),
          docs::hog_color_cells);
    m.def("color_posterior", color_posterior_arrays, py::arg("image"), py::arg("table"),
          docs::color_posterior);
    m.def("pick_pixels", pick_pixels_arrays, py::arg("image"), py::arg("places"), docs::pick_pixels);
    m.def("box_contrast", box_contrast_arrays, py::arg("plane"), py::arg("width"), py::arg("height"),
          py::arg("surround_size"), py::arg("surround_weight"), docs::box_contrast);
}

}  // namespace tricue::bindings
