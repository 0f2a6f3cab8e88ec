// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/color/bhattacharyya.hpp"
#include "cues/color/color_histogram.hpp"
#include "cues/color/color_lookup.hpp"
#include "cues/color/rank_sections.hpp"
#include "cues/color/section_distance.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;

Array<float> color_histogram_arrays(const Bytes& pixels, int bins) {
    const auto view = samples(pixels, "samples");
    return give(unlocked([&] { return color_histogram(view, bins); }));
}

Array<double> bhattacharyya_arrays(const Array<float>& histograms, const Array<float>& model, int groups) {
    const auto each = floats(histograms, "histograms", {-1, -1}, "float32 (N, K)");
    const auto target = floats(model, "model", {-1}, "float32 (K,)");
    return give(unlocked([&] { return bhattacharyya(each, target, groups); }));
}

Array<float> color_lookup_arrays(const Bytes& pixels, const Array<float>& table) {
    const char* expected = "float32 (B, B, B)";
    const auto view = samples(pixels, "samples");
    const auto side = require<float>(table, "table", 3, expected).shape(0);
    const auto cube = floats(table, "table", {side, side, side}, expected);
    return give(unlocked([&] { return color_lookup(view, cube); }));
}

Array<float> rank_sections_arrays(const Bytes& pixels, int sections) {
    const auto view = samples(pixels, "samples");
    const py::array rows = give(unlocked([&] { return rank_sections(view, sections); }));
    return rows.attr("reshape")(view.ellipses, 3, sections);
}

Array<double> section_distance_arrays(const Array<float>& sections, const Array<float>& model) {
    const auto each = floats(sections, "sections", {-1, 3, -1}, "float32 (N, 3, S)");
    const auto target = floats(model, "model", {3, -1}, "float32 (3, S)");
    return give(unlocked([&] { return section_distance(each, target); }));
}

}  // namespace

void define_color(py::module_& m) {
    m.def("color_histogram", color_histogram_arrays, py::arg("samples"), py::arg("bins"),
          "Histograms (N, 3 bins) of the samples of each ellipse, each channel's bins of sum 1.");
    m.def("bhattacharyya", bhattacharyya_arrays, py::arg("histograms"), py::arg("model"), py::arg("groups"),
          "(N,) sqrt(1 - mean over the groups of sum sqrt(p q)), in [0, 1].");
    m.def("color_lookup", color_lookup_arrays, py::arg("samples"), py::arg("table"),
          "table[b B/256, g B/256, r B/256] of every sample: (N, n).");
    m.def("rank_sections", rank_sections_arrays, py::arg("samples"), py::arg("sections"),
          "Sums of rank measures over the levels of every section, (N, 3, S), equations (17), (19)-(28), each of sum 1.");
    m.def("section_distance", section_distance_arrays, py::arg("sections"), py::arg("model"),
          "(N,) equation (29) divided by 3 sqrt 2, in [0, 1].");
}

}  // namespace tricue::bindings
