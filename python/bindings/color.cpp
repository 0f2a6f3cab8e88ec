// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/color/bhattacharyya.hpp"
#include "cues/color/color_histogram.hpp"
#include "cues/color/color_lookup.hpp"
#include "cues/color/color_ranks.hpp"
#include "cues/color/joint_histogram.hpp"
#include "cues/color/learn_contrast.hpp"
#include "cues/color/learn_ranks.hpp"
#include "cues/color/rank_distance.hpp"
#include "cues/color/rank_likelihood.hpp"
#include "cues/color/rank_search.hpp"
#include "cues/color/rank_sections.hpp"
#include "cues/color/rank_window.hpp"
#include "cues/color/sample_ellipses.hpp"
#include "cues/color/section_distance.hpp"
#include "kernel_docs.hpp"
#include "rank_arguments.hpp"

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
    auto ranks = unlocked(view.ellipses * view.n, [&] { return color_ranks(view); });
    return give(std::move(ranks), {view.ellipses, 3, view.n});
}

Array<double> rank_distance_arrays(const Bytes& pixels, const Array<float>& models) {
    const auto view = samples(pixels, "samples");
    const auto rows = rank_maps(models, view.n);
    return give(unlocked(3 * view.ellipses * view.n, [&] { return rank_distance(view, rows); }));
}

Array<double> rank_likelihood_arrays(const Bytes& image, const Array<double>& ellipses,
                                     const PatternTuple& pattern, const AppearanceTuple& appearance,
                                     const FactorsTuple& factors) {
    const auto view = color_image(image, "image");
    const auto each = states(ellipses, "ellipses");
    const EllipsePattern places = ellipse_pattern(pattern);
    const auto n = places.inside.rows();
    const ColorAppearance target = color_appearance(appearance, n);
    const LikelihoodFactors nats = likelihood_factors(factors);
    return give(unlocked(each.rows() * n, [&] { return rank_likelihood(view, each, places, target, nats); }));
}

std::tuple<Array<double>, double, double> rank_search_arrays(const Bytes& image, const Array<double>& ellipse,
                                                             const Array<double>& offsets,
                                                             const PatternTuple& pattern,
                                                             const AppearanceTuple& appearance,
                                                             const FactorsTuple& factors) {
    const auto view = color_image(image, "image");
    const auto where = vector(ellipse, "ellipse");
    const auto windows = states(offsets, "offsets");
    const EllipsePattern places = ellipse_pattern(pattern);
    const ColorAppearance target = color_appearance(appearance, places.inside.rows());
    const auto work = work_of(windows.rows() + 1, places.inside.rows() + places.around.rows());
    const LikelihoodFactors nats = likelihood_factors(factors);
    auto found = unlocked(work, [&] { return rank_search(view, where, windows, places, target, nats); });
    return {give(std::move(found.ellipse)), found.log_likelihood, found.log_likelihood_here};
}

std::tuple<Array<float>, Array<double>> rank_window_arrays(const Bytes& image, const Array<double>& ellipse,
                                                           const Array<double>& pattern,
                                                           const Array<float>& models, double flat) {
    const auto view = color_image(image, "image");
    const auto places = states(pattern, "pattern");
    const auto where = vector(ellipse, "ellipse");
    const auto maps = rank_maps(models, places.rows());
    auto [ranks, correlations] = unlocked(work_of(places.rows(), maps.rows() + 1),
                                          [&] { return rank_window(view, where, places, maps, flat); });
    return {give(std::move(ranks), {3, places.rows()}), give(std::move(correlations))};
}

Array<float> learn_ranks_arrays(const Array<float>& models, const Array<float>& ranks, double rate) {
    const auto seen = floats(ranks, "ranks", {3, -1}, "float32 (3, n)");
    const auto places = seen.cols();
    const Eigen::Map<const Floats> row(seen.data(), 1, 3 * places);
    const auto maps = rank_maps(models, places);
    return give(unlocked(maps.size(), [&] { return learn_ranks(maps, row, rate); }),
                {maps.rows(), 3, places});
}

std::tuple<Array<float>, Array<float>, Array<float>> learn_contrast_arrays(
    const Bytes& image, const Array<double>& ellipse, const PatternTuple& pattern, const Array<float>& target,
    const Array<float>& surround, double rate, double rare) {
    const auto view = color_image(image, "image");
    const auto where = vector(ellipse, "ellipse");
    const EllipsePattern places = ellipse_pattern(pattern);
    const auto known = color_cube(target, "target"), other = color_cube(surround, "surround");
    auto [own, round, rule] =
        unlocked(known.size(), [&] { return learn_contrast(view, where, places, known, other, rate, rare); });
    const std::vector<py::ssize_t> cube(3, known.cols());
    return {give(std::move(own), cube), give(std::move(round), cube), give(std::move(rule), cube)};
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
    const auto view = samples(pixels, "samples");
    const auto cube = color_cube(table);
    return give(unlocked(view.ellipses * view.n, [&] { return color_lookup(view, cube); }));
}

Array<float> rank_sections_arrays(const Bytes& pixels, int sections) {
    const auto view = samples(pixels, "samples");
    auto sums = unlocked(view.ellipses * view.n, [&] { return rank_sections(view, sections); });
    return give(std::move(sums), {view.ellipses, 3, sections});
}

Array<double> section_distance_arrays(const Array<float>& sections, const Array<float>& model) {
    const auto each = floats(sections, "sections", {-1, 3, -1}, "float32 (N, 3, S)");
    const auto target = floats(model, "model", {3, -1}, "float32 (3, S)");
    return give(unlocked(each.size(), [&] { return section_distance(each, target); }));
}

}  // namespace

void define_color(py::module_& m) {
    m.def("sample_ellipses", sample_ellipses_arrays, py::arg("image"), py::arg("ellipses"),
          py::arg("pattern"), docs::sample_ellipses);
    m.def("color_ranks", color_ranks_arrays, py::arg("samples"), docs::color_ranks);
    m.def("learn_contrast", learn_contrast_arrays, py::arg("image"), py::arg("ellipse"), py::arg("pattern"),
          py::arg("target"), py::arg("surround"), py::arg("rate"), py::arg("rare"), docs::learn_contrast);
    m.def("learn_ranks", learn_ranks_arrays, py::arg("models"), py::arg("ranks"), py::arg("rate"),
          docs::learn_ranks);
    m.def("rank_distance", rank_distance_arrays, py::arg("samples"), py::arg("models"), docs::rank_distance);
    m.def("rank_likelihood", rank_likelihood_arrays, py::arg("image"), py::arg("ellipses"),
          py::arg("pattern"), py::arg("appearance"), py::arg("factors"), docs::rank_likelihood);
    m.def("rank_search", rank_search_arrays, py::arg("image"), py::arg("ellipse"), py::arg("offsets"),
          py::arg("pattern"), py::arg("appearance"), py::arg("factors"), docs::rank_search);
    m.def("rank_window", rank_window_arrays, py::arg("image"), py::arg("ellipse"), py::arg("pattern"),
          py::arg("models"), py::arg("flat"), docs::rank_window);
    m.def("joint_histogram", joint_histogram_arrays, py::arg("samples"), py::arg("bins"),
          docs::joint_histogram);
    m.def("color_histogram", color_histogram_arrays, py::arg("samples"), py::arg("bins"),
          docs::color_histogram);
    m.def("bhattacharyya", bhattacharyya_arrays, py::arg("histograms"), py::arg("model"), py::arg("groups"),
          docs::bhattacharyya);
    m.def("color_lookup", color_lookup_arrays, py::arg("samples"), py::arg("table"), docs::color_lookup);
    m.def("rank_sections", rank_sections_arrays, py::arg("samples"), py::arg("sections"),
          docs::rank_sections);
    m.def("section_distance", section_distance_arrays, py::arg("sections"), py::arg("model"),
          docs::section_distance);
}

}  // namespace tricue::bindings
