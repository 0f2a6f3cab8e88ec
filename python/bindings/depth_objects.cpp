// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/depth/complete_body.hpp"
#include "cues/depth/cut_sides.hpp"
#include "cues/depth/density_extrema.hpp"
#include "cues/depth/depth_components.hpp"
#include "cues/depth/depth_contrast.hpp"
#include "cues/depth/depth_density.hpp"
#include "cues/depth/depth_distance.hpp"
#include "cues/depth/match_object.hpp"
#include "cues/depth/measure_objects.hpp"
#include "cues/depth/rectangle_histogram.hpp"
#include "cues/depth/segment_depth.hpp"
#include "kernel_docs.hpp"

namespace tricue::bindings {
namespace {

Array<double> depth_density_arrays(const Array<double>& histogram, double bandwidth) {
    const auto counts = vector(histogram, "histogram");
    return give(unlocked(counts.size(), [&] { return depth_density(counts, bandwidth); }));
}

std::tuple<Array<std::int64_t>, Array<std::int64_t>> density_extrema_arrays(const Array<double>& density,
                                                                            double prominence) {
    const auto levels = vector(density, "density");
    auto extrema = unlocked(levels.size(), [&] { return density_extrema(levels, prominence); });
    return {give(std::move(extrema.maxima)), give(std::move(extrema.minima))};
}

std::tuple<Array<double>, Array<float>, Array<float>, Array<float>, Array<std::int32_t>>
depth_components_arrays(const Array<std::uint8_t>& labels, const Array<float>& depth, double near, double far,
                        int levels, int bins, int min_area, bool image) {
    const auto regions = mask_image(labels, "labels", "uint8 labels (H, W)");
    const auto meters = depth_image(depth, "depth");
    const HistogramLayout layout{near, far, levels, bins};
    auto found = unlocked(std::ptrdiff_t{meters.rows} * meters.cols,
                          [&] { return depth_components(regions, meters, layout, min_area, image); });
    return {give(std::move(found.table)), give(std::move(found.histograms)), give(std::move(found.columns)),
            give(std::move(found.rows)), give(std::move(found.image))};
}

Array<double> depth_distance_arrays(const Array<float>& depth, const Array<double>& rectangles,
                                    const Array<double>& model, const Array<double>& pattern, double reach,
                                    double occluder_margin) {
    const auto meters = depth_image(depth, "depth");
    const auto each = states(rectangles, "rectangles");
    const ReferenceHistogram target{vector(model, "model"), reach};
    const auto places = states(pattern, "pattern");
    return give(unlocked(each.rows() * places.rows(),
                         [&] { return depth_distance(meters, each, target, places, occluder_margin); }));
}

Array<double> rectangle_histogram_arrays(const Array<float>& depth, const Array<double>& rectangle,
                                         int levels, const Array<double>& pattern, double reach) {
    const auto meters = depth_image(depth, "depth");
    const auto numbers = vector(rectangle, "rectangle");
    const auto places = states(pattern, "pattern");
    return give(
        unlocked(places.rows(), [&] { return rectangle_histogram(meters, numbers, levels, places, reach); }));
}

Array<double> depth_contrast_arrays(const Array<float>& depth, const Array<double>& camera,
                                    const Array<double>& states_, const Array<double>& model,
                                    std::pair<int, int> grid, std::pair<double, int> ring, double reach,
                                    double occluder_margin) {
    const auto meters = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto each = states(states_, "states");
    const ReferenceHistogram target{vector(model, "model"), reach};
    const RectanglePattern places{grid.first, grid.second, ring.first, ring.second};
    const auto work = work_of(grid.first, grid.second, each.rows());
    return give(
        unlocked(work, [&] { return depth_contrast(meters, lens, each, target, places, occluder_margin); }));
}

Array<bool> cut_sides_arrays(const Array<float>& depth, const Array<double>& table,
                             const Array<double>& camera, int border, double beside, double occluder_margin,
                             double share) {
    const auto meters = depth_image(depth, "depth");
    const auto boxes = states(table, "table");
    const auto lens = vector(camera, "camera");
    const auto work = boxes.rows() * 48;  // places
    return give(unlocked(
        work, [&] { return cut_sides(meters, boxes, lens, {border, beside, occluder_margin, share}); }));
}

Eigen::Map<const Flags> flags(const Array<bool>& object, const char* name, int columns) {
    const std::string expected = "bool (C, " + std::to_string(columns) + ")";
    const auto array = require<bool>(object, name, 2, expected.c_str());
    if (array.shape(1) != columns)
        throw py::value_error(std::string(name) + ": expected " + expected + ", got " + describe(array));
    return {contiguous<bool>(array, name), array.shape(0), array.shape(1)};
}

Array<double> measure_objects_arrays(const Array<double>& table, const Array<float>& columns,
                                     const Array<float>& rows, const Array<bool>& cut,
                                     const Array<double>& camera, const Array<double>& plane, double feet) {
    const auto boxes = states(table, "table");
    const auto across = floats(columns, "columns", {-1, -1}, "float32 (C, bins)");
    const auto down = floats(rows, "rows", {-1, -1}, "float32 (C, bins)");
    const auto sides = flags(cut, "cut", 4);
    const auto lens = vector(camera, "camera");
    const auto floor = vector(plane, "plane");
    return give(unlocked(across.size() + down.size(),
                         [&] { return measure_objects({boxes, across, down, sides}, lens, {floor, feet}); }));
}

/// Views of the caller's arrays.
ObjectFeatures object_features(const Array<double>& measured, const Array<bool>& cut,
                               const Array<float>& columns, const Array<float>& rows) {
    return {states(measured, "measured"), flags(cut, "cut", 4),
            floats(columns, "columns", {-1, -1}, "float32 (C, bins)"),
            floats(rows, "rows", {-1, -1}, "float32 (C, bins)")};
}

/// Of the width and of the height.
std::pair<bool, bool> known_sizes(const Array<bool>& known) {
    const auto array = require<bool>(known, "known", 1, "bool (2,)");
    if (array.shape(0) != 2) throw py::value_error("known: expected bool (2,), got " + describe(array));
    const bool* each = contiguous<bool>(array, "known");
    return {each[0], each[1]};
}

int match_object_arrays(const Array<double>& measured, const Array<bool>& cut, const Array<float>& columns,
                        const Array<float>& rows, const Array<double>& others, const Array<double>& expected,
                        std::pair<Array<double>, Array<bool>> mean_size, const Array<double>& signature,
                        std::tuple<double, double, double, double, double> deviation,
                        std::pair<double, double> unknown, double signature_cost,
                        std::pair<double, double> gate, bool complete) {
    const auto objects = object_features(measured, cut, columns, rows);
    const auto more = vector(others, "others");
    const auto [width_known, height_known] = known_sizes(mean_size.second);
    const ExpectedTarget target{vector(expected, "expected"), vector(mean_size.first, "size"), width_known,
                                height_known, vector(signature, "signature")};
    const auto [x, y, z, share, base] = deviation;
    const auto [center, larger] = unknown;
    const MatchCosts costs{x, y, z, share, base, center, larger, signature_cost, gate.first, gate.second};
    const auto work = objects.columns.size() + objects.rows.size();
    return unlocked(work, [&] { return match_object(objects, more, target, costs, complete); });
}

std::tuple<Array<double>, Array<bool>, Array<double>, Array<double>> complete_body_arrays(
    const Array<double>& measured, const Array<bool>& cut, const Array<float>& columns,
    const Array<float>& rows, int index, const Array<double>& expected,
    std::pair<Array<double>, Array<bool>> mean_size, std::tuple<double, double, double, double> pieces) {
    const auto objects = object_features(measured, cut, columns, rows);
    const auto [width_known, height_known] = known_sizes(mean_size.second);
    const ExpectedBody where{vector(expected, "expected"), vector(mean_size.first, "size"), width_known,
                             height_known};
    const auto [region, inside, joined, depth] = pieces;
    const PieceLimits limits{region, inside, joined, depth};
    auto body =
        unlocked(objects.measured.size(), [&] { return complete_body(objects, index, where, limits); });
    return {give(std::move(body.state)), give(std::move(body.whole), {2}), give(std::move(body.size)),
            give(std::move(body.signature))};
}

std::tuple<Array<double>, Array<bool>, Array<float>, Array<float>> segment_depth_arrays(
    const Array<float>& depth, const Array<float>& before, std::pair<double, double> noise,
    const RegionTuple& region, const Array<double>& camera, const Array<double>& plane,
    const RegionTuple& measured, std::tuple<double, double, int> levels, std::pair<double, double> edges,
    std::pair<double, double> density, int min_area, std::tuple<int, double, double, double> cut,
    double feet) {
    const auto meters = depth_image(depth, "depth");
    const SearchedPixels searched{region_of(region), depth_image(before, "before"), noise.first,
                                  noise.second};
    const auto lens = vector(camera, "camera");
    const auto floor = vector(plane, "plane");
    const auto [near, far, count] = levels;
    const Divisions divisions{{near, far, count}, edges.first,    edges.second,
                              density.first,      density.second, min_area};
    const auto [border, beside, occluder_margin, share] = cut;
    const Cut sides{border, beside, occluder_margin, share};
    auto found = unlocked(std::ptrdiff_t{meters.rows} * meters.cols, [&] {
        return segment_depth(meters, searched, lens, floor, region_of(measured), divisions, sides, feet);
    });
    return {give(std::move(found.measured)), give(std::move(found.cut)), give(std::move(found.columns)),
            give(std::move(found.rows))};
}

}  // namespace

void define_depth_objects(py::module_& m) {
    m.def("complete_body", complete_body_arrays, py::arg("measured"), py::arg("cut"), py::arg("columns"),
          py::arg("rows"), py::arg("index"), py::arg("expected"), py::arg("mean_size"), py::arg("pieces"),
          docs::complete_body);
    m.def("match_object", match_object_arrays, py::arg("measured"), py::arg("cut"), py::arg("columns"),
          py::arg("rows"), py::arg("others"), py::arg("expected"), py::arg("mean_size"), py::arg("signature"),
          py::arg("deviation"), py::arg("unknown"), py::arg("signature_cost"), py::arg("gate"),
          py::arg("complete"), docs::match_object);
    m.def("cut_sides", cut_sides_arrays, py::arg("depth"), py::arg("table"), py::arg("camera"),
          py::arg("border"), py::arg("beside"), py::arg("occluder_margin"), py::arg("share"),
          docs::cut_sides);
    m.def("depth_contrast", depth_contrast_arrays, py::arg("depth"), py::arg("camera"), py::arg("states"),
          py::arg("model"), py::arg("grid"), py::arg("ring"), py::arg("reach"), py::arg("occluder_margin"),
          docs::depth_contrast);
    m.def("depth_density", depth_density_arrays, py::arg("histogram"), py::arg("bandwidth"),
          docs::depth_density);
    m.def("segment_depth", segment_depth_arrays, py::arg("depth"), py::arg("before"), py::arg("noise"),
          py::arg("region"), py::arg("camera"), py::arg("plane"), py::arg("measured"), py::arg("levels"),
          py::arg("edges"), py::arg("density"), py::arg("min_area"), py::arg("cut"), py::arg("feet"),
          docs::segment_depth);
    m.def("density_extrema", density_extrema_arrays, py::arg("density"), py::arg("prominence"),
          docs::density_extrema);
    m.def("depth_components", depth_components_arrays, py::arg("labels"), py::arg("depth"), py::arg("near"),
          py::arg("far"), py::arg("levels"), py::arg("bins"), py::arg("min_area"), py::arg("image"),
          docs::depth_components);
    m.def("depth_distance", depth_distance_arrays, py::arg("depth"), py::arg("rectangles"), py::arg("model"),
          py::arg("pattern"), py::arg("reach"), py::arg("occluder_margin"), docs::depth_distance);
    m.def("measure_objects", measure_objects_arrays, py::arg("table"), py::arg("columns"), py::arg("rows"),
          py::arg("cut"), py::arg("camera"), py::arg("plane"), py::arg("feet"), docs::measure_objects);
    m.def("rectangle_histogram", rectangle_histogram_arrays, py::arg("depth"), py::arg("rectangle"),
          py::arg("levels"), py::arg("pattern"), py::arg("reach"), docs::rectangle_histogram);
}

}  // namespace tricue::bindings
