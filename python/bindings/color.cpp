// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/color/bhattacharyya.hpp"
#include "cues/color/color_histogram.hpp"
#include "cues/color/color_lookup.hpp"
#include "cues/color/color_ranks.hpp"
#include "cues/color/joint_histogram.hpp"
#include "cues/color/rank_distance.hpp"
#include "cues/color/rank_sections.hpp"
#include "cues/color/sample_ellipses.hpp"
#include "cues/color/section_distance.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;

Bytes sample_ellipses_arrays(const Bytes& image, const Array<double>& ellipses,
                             const Array<double>& pattern) {
    const auto view = color_image(image, "image");
    const auto each = states(ellipses, "ellipses");
    const auto places = states(pattern, "pattern");
    py::array_t<std::uint8_t> pixels({each.rows(), Eigen::Index{3}, places.rows()});
    auto* out = pixels.mutable_data();
    unlocked(each.rows() * places.rows(), [&] {
        sample_ellipses(view, each, places, out);
        return 0;
    });
    return pixels;
}

Array<float> color_ranks_arrays(const Bytes& pixels) {
    const auto view = samples(pixels, "samples");
    const py::array rows = give(unlocked(view.ellipses * view.n, [&] { return color_ranks(view); }));
    return rows.attr("reshape")(view.ellipses, 3, view.n);
}

Array<double> rank_distance_arrays(const Bytes& pixels, const Array<float>& models) {
    const char* expected = "float32 (M, 3, n)";
    const auto view = samples(pixels, "samples");
    const auto maps = floats(models, "models", {-1, 3, view.n}, expected);
    const Eigen::Map<const Floats> rows(maps.data(), maps.rows() / 3, 3 * maps.cols());
    return give(unlocked(3 * view.ellipses * view.n, [&] { return rank_distance(view, rows); }));
}

Array<float> joint_histogram_arrays(const Bytes& pixels, int bins) {
    const auto view = samples(pixels, "samples");
    return give(unlocked(view.ellipses * view.n, [&] { return joint_histogram(view, bins); }));
}

Array<float> color_histogram_arrays(const Bytes& pixels, int bins) {
    const auto view = samples(pixels, "samples");
    return give(unlocked(view.ellipses * view.n, [&] { return color_histogram(view, bins); }));
}

Array<double> bhattacharyya_arrays(const Array<float>& histograms, const Array<float>& model, int groups) {
    const auto each = floats(histograms, "histograms", {-1, -1}, "float32 (N, K)");
    const auto target = floats(model, "model", {-1}, "float32 (K,)");
    return give(unlocked(each.size(), [&] { return bhattacharyya(each, target, groups); }));
}

Array<float> color_lookup_arrays(const Bytes& pixels, const Array<float>& table) {
    const char* expected = "float32 (B, B, B)";
    const auto view = samples(pixels, "samples");
    const auto side = require<float>(table, "table", 3, expected).shape(0);
    const auto cube = floats(table, "table", {side, side, side}, expected);
    return give(unlocked(view.ellipses * view.n, [&] { return color_lookup(view, cube); }));
}

Array<float> rank_sections_arrays(const Bytes& pixels, int sections) {
    const auto view = samples(pixels, "samples");
    const py::array rows =
        give(unlocked(view.ellipses * view.n, [&] { return rank_sections(view, sections); }));
    return rows.attr("reshape")(view.ellipses, 3, sections);
}

Array<double> section_distance_arrays(const Array<float>& sections, const Array<float>& model) {
    const auto each = floats(sections, "sections", {-1, 3, -1}, "float32 (N, 3, S)");
    const auto target = floats(model, "model", {3, -1}, "float32 (3, S)");
    return give(unlocked(each.size(), [&] { return section_distance(each, target); }));
}

}  // namespace

void define_color(py::module_& m) {
    m.def("sample_ellipses", sample_ellipses_arrays, py::arg("image"), py::arg("ellipses"),
          py::arg("pattern"),
          "The pixels (N, 3, n) at the places (u, v) of the pattern (n, 2) in each ellipse (N, 4): x, y, "
          "minor, major.");
    m.def("color_ranks", color_ranks_arrays, py::arg("samples"),
          "Mid-ranks (N, 3, n) of the samples in their own ellipse and channel, equation (17).");
    m.def("rank_distance", rank_distance_arrays, py::arg("samples"), py::arg("models"),
          "(N, M) twice the mean absolute difference between the samples' mid-ranks and each rank map (M, 3, "
          "n), in [0, 1].");
    m.def("joint_histogram", joint_histogram_arrays, py::arg("samples"), py::arg("bins"),
          "Joint color histograms (N, bins^3) of sum 1; cell (b bins + g) bins + r.");
    m.def("color_histogram", color_histogram_arrays, py::arg("samples"), py::arg("bins"),
          "Histograms (N, 3 bins) of the samples of each ellipse, each channel's bins of sum 1.");
    m.def("bhattacharyya", bhattacharyya_arrays, py::arg("histograms"), py::arg("model"), py::arg("groups"),
          "(N,) sqrt(1 - mean over the groups of sum sqrt(p q)), in [0, 1].");
    m.def("color_lookup", color_lookup_arrays, py::arg("samples"), py::arg("table"),
          "table[b B/256, g B/256, r B/256] of every sample: (N, n).");
    m.def("rank_sections", rank_sections_arrays, py::arg("samples"), py::arg("sections"),
          "Sums of rank measures over the levels of every section, (N, 3, S), equations (17), (19)-(28), "
          "each of sum 1.");
    m.def("section_distance", section_distance_arrays, py::arg("sections"), py::arg("model"),
          "(N,) equation (29) divided by 3 sqrt 2, in [0, 1].");
}

}  // namespace tricue::bindings
