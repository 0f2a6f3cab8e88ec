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
#include "tuples.hpp"

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

using ReferenceTuple = Tuple<Array<double>, double>;

ReferenceHistogram reference_histogram(const ReferenceTuple& model) {
    const auto [histogram, reach] = unpack(model, "model");
    return {vector(histogram, "model"), reach};
}

Array<double> depth_distance_arrays(const Array<float>& depth, const Array<double>& rectangles,
                                    const ReferenceTuple& model, const Array<double>& pattern,
                                    double occluder_margin) {
    const auto meters = depth_image(depth, "depth");
    const auto each = states(rectangles, "rectangles");
    const ReferenceHistogram target = reference_histogram(model);
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
                                    const Array<double>& rectangles, const ReferenceTuple& model,
                                    const Tuple<int, int, double, int>& places, double occluder_margin) {
    const auto meters = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto each = states(rectangles, "states");
    const ReferenceHistogram target = reference_histogram(model);
    const auto pattern = unpack_as<RectanglePattern>(places, "places");
    const auto work = work_of(pattern.rows, pattern.columns, each.rows());
    return give(
        unlocked(work, [&] { return depth_contrast(meters, lens, each, target, pattern, occluder_margin); }));
}

using CutTuple = Tuple<int, double, double, double>;

Array<bool> cut_sides_arrays(const Array<float>& depth, const Array<double>& table,
                             const Array<double>& camera, const CutTuple& cut) {
    const auto meters = depth_image(depth, "depth");
    const auto boxes = states(table, "table");
    const auto lens = vector(camera, "camera");
    const auto sides = unpack_as<Cut>(cut, "cut");
    const auto work = boxes.rows() * 48;  // places
    return give(unlocked(work, [&] { return cut_sides(meters, boxes, lens, sides); }));
}

Eigen::Map<const Flags> flags(const Array<bool>& object, const char* name, int columns) {
    const std::string expected = "bool (C, " + std::to_string(columns) + ")";
    const auto array = require<bool>(object, name, 2, expected.c_str());
    if (array.shape(1) != columns)
        throw py::value_error(std::string(name) + ": expected " + expected + ", got " + describe(array));
    return {contiguous<bool>(array, name), array.shape(0), array.shape(1)};
}

using GroundTuple = Tuple<Array<double>, double>;

Ground ground_of(const GroundTuple& ground) {
    const auto [plane, feet] = unpack(ground, "ground");
    return {vector(plane, "plane"), feet};
}

Array<double> measure_objects_arrays(
    const Tuple<Array<double>, Array<float>, Array<float>, Array<bool>>& objects, const Array<double>& camera,
    const GroundTuple& ground) {
    const auto [table, columns, rows, cut] = unpack(objects, "objects");
    const ObjectTable each{states(table, "table"), floats(columns, "columns", {-1, -1}, "float32 (C, bins)"),
                           floats(rows, "rows", {-1, -1}, "float32 (C, bins)"), flags(cut, "cut", 4)};
    const auto lens = vector(camera, "camera");
    const Ground floor = ground_of(ground);
    return give(
        unlocked(each.columns.size() + each.rows.size(), [&] { return measure_objects(each, lens, floor); }));
}

using ObjectsTuple = Tuple<Array<double>, Array<bool>, Array<float>, Array<float>>;
using BodyTuple = Tuple<Array<double>, Array<double>, Array<bool>>;

/// Views of the caller's arrays.
ObjectFeatures object_features(const ObjectsTuple& objects) {
    const auto [measured, cut, columns, rows] = unpack(objects, "objects");
    return {states(measured, "measured"), flags(cut, "cut", 4),
            floats(columns, "columns", {-1, -1}, "float32 (C, bins)"),
            floats(rows, "rows", {-1, -1}, "float32 (C, bins)")};
}

/// Of the width and of the height.
std::array<bool, 2> known_sizes(const Array<bool>& known) {
    const auto array = require<bool>(known, "known", 1, "bool (2,)");
    if (array.shape(0) != 2) throw py::value_error("known: expected bool (2,), got " + describe(array));
    const bool* each = contiguous<bool>(array, "known");
    return {each[0], each[1]};
}

ExpectedBody expected_body(const BodyTuple& expected) {
    const auto [state, size, known] = unpack(expected, "expected");
    return {vector(state, "state"), vector(size, "size"), known_sizes(known)};
}

using CostsTuple =
    Tuple<Tuple<double, double, double, double, double>, Tuple<double, double>, double, double, double>;

MatchCosts match_costs(const CostsTuple& costs) {
    const auto [deviation, unknown, signature_cost, max_cost, min_area] = unpack(costs, "costs");
    return {unpack_as<MatchDeviation>(deviation, "deviation"), unpack_as<UnknownWeights>(unknown, "unknown"),
            signature_cost, max_cost, min_area};
}

int match_object_arrays(const ObjectsTuple& objects, const Array<double>& others, const BodyTuple& expected,
                        const Array<double>& signature, const CostsTuple& costs, bool complete) {
    const ObjectFeatures each = object_features(objects);
    const auto more = vector(others, "others"), shape = vector(signature, "signature");
    const ExpectedBody target = expected_body(expected);
    const MatchCosts nats = match_costs(costs);
    const auto work = each.columns.size() + each.rows.size();
    return unlocked(work, [&] { return match_object(each, more, target, shape, nats, complete); });
}

std::tuple<Array<double>, Array<bool>, Array<double>, Array<double>> complete_body_arrays(
    const ObjectsTuple& objects, int index, const BodyTuple& expected,
    const Tuple<double, double, double, double>& limits) {
    const ObjectFeatures each = object_features(objects);
    const ExpectedBody where = expected_body(expected);
    const auto pieces = unpack_as<PieceLimits>(limits, "limits");
    auto body = unlocked(each.measured.size(), [&] { return complete_body(each, index, where, pieces); });
    return {give(std::move(body.state)), give(std::move(body.whole), {2}), give(std::move(body.size)),
            give(std::move(body.signature))};
}

using SearchedTuple = Tuple<Tuple<int, int, int, int>, Array<float>, double, double>;
using DivisionsTuple = Tuple<Tuple<double, double, int>, double, double, double, double, int>;

Divisions divisions_of(const DivisionsTuple& divisions) {
    const auto [levels, gap, slope, bandwidth, prominence, min_area] = unpack(divisions, "divisions");
    return {unpack_as<DepthLevels>(levels, "levels"), gap, slope, bandwidth, prominence, min_area};
}

std::tuple<Array<double>, Array<bool>, Array<float>, Array<float>> segment_depth_arrays(
    const Array<float>& depth, const SearchedTuple& searched, const Array<double>& camera,
    const GroundTuple& ground, const RegionTuple& measured, const DivisionsTuple& divisions,
    const CutTuple& cut) {
    const auto meters = depth_image(depth, "depth");
    const auto [region, before, noise, noise_slope] = unpack(searched, "searched");
    const SearchedPixels pixels{unpack_as<Region>(region, "region"), depth_image(before, "before"), noise,
                                noise_slope};
    const auto lens = vector(camera, "camera");
    const Ground floor = ground_of(ground);
    const Divisions by = divisions_of(divisions);
    const auto sides = unpack_as<Cut>(cut, "cut");
    auto found = unlocked(std::ptrdiff_t{meters.rows} * meters.cols, [&] {
        return segment_depth(meters, pixels, lens, floor, region_of(measured), by, sides);
    });
    return {give(std::move(found.measured)), give(std::move(found.cut)), give(std::move(found.columns)),
            give(std::move(found.rows))};
}

}  // namespace

void define_depth_objects(py::module_& m) {
    m.def("complete_body", complete_body_arrays, py::arg("objects"), py::arg("index"), py::arg("expected"),
          py::arg("limits"), docs::complete_body);
    m.def("match_object", match_object_arrays, py::arg("objects"), py::arg("others"), py::arg("expected"),
          py::arg("signature"), py::arg("costs"), py::arg("complete"), docs::match_object);
    m.def("cut_sides", cut_sides_arrays, py::arg("depth"), py::arg("table"), py::arg("camera"),
          py::arg("cut"), docs::cut_sides);
    m.def("depth_contrast", depth_contrast_arrays, py::arg("depth"), py::arg("camera"), py::arg("states"),
          py::arg("model"), py::arg("places"), py::arg("occluder_margin"), docs::depth_contrast);
    m.def("depth_density", depth_density_arrays, py::arg("histogram"), py::arg("bandwidth"),
          docs::depth_density);
    m.def("segment_depth", segment_depth_arrays, py::arg("depth"), py::arg("searched"), py::arg("camera"),
          py::arg("ground"), py::arg("measured"), py::arg("divisions"), py::arg("cut"), docs::segment_depth);
    m.def("density_extrema", density_extrema_arrays, py::arg("density"), py::arg("prominence"),
          docs::density_extrema);
    m.def("depth_components", depth_components_arrays, py::arg("labels"), py::arg("depth"), py::arg("near"),
          py::arg("far"), py::arg("levels"), py::arg("bins"), py::arg("min_area"), py::arg("image"),
          docs::depth_components);
    m.def("depth_distance", depth_distance_arrays, py::arg("depth"), py::arg("rectangles"), py::arg("model"),
          py::arg("pattern"), py::arg("occluder_margin"), docs::depth_distance);
    m.def("measure_objects", measure_objects_arrays, py::arg("objects"), py::arg("camera"), py::arg("ground"),
          docs::measure_objects);
    m.def("rectangle_histogram", rectangle_histogram_arrays, py::arg("depth"), py::arg("rectangle"),
          py::arg("levels"), py::arg("pattern"), py::arg("reach"), docs::rectangle_histogram);
}

}  // namespace tricue::bindings
