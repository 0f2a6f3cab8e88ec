// SPDX-License-Identifier: MIT
#include <algorithm>

#include "arrays.hpp"
#include "cues/depth/above_floor.hpp"
#include "cues/depth/changed_depth.hpp"
#include "cues/depth/depth_edges.hpp"
#include "cues/depth/depth_histogram.hpp"
#include "cues/depth/depth_picture.hpp"
#include "cues/depth/depth_posterior.hpp"
#include "cues/depth/divide_depth.hpp"
#include "cues/depth/fill_gaps.hpp"
#include "cues/depth/find_foreground.hpp"
#include "cues/depth/floor_plane.hpp"
#include "cues/depth/ground_distance.hpp"
#include "cues/depth/median_depths.hpp"
#include "cues/depth/plane_support.hpp"
#include "cues/depth/remember_depth.hpp"
#include "cues/depth/support_pixels.hpp"
#include "kernel_docs.hpp"
#include "tuples.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;

Bytes changed_depth_arrays(const Array<float>& depth, const Array<float>& before, double noise,
                           double slope) {
    const auto view = depth_image(depth, "depth");
    const auto old = depth_image(before, "before");
    return give(unlocked(pixels(view), [&] { return changed_depth(view, old, noise, slope); }));
}

Array<float> remember_depth_arrays(const Array<float>& depth, const Array<float>& before,
                                   const RegionTuple& region, double z, double reach) {
    const auto view = depth_image(depth, "depth");
    const auto old = depth_image(before, "before");
    const Region place = region_of(region);
    return give(unlocked(pixels(view), [&] { return remember_depth(view, old, place, z, reach); }));
}

Bytes depth_edges_arrays(const Array<float>& depth, double gap, double slope) {
    const auto view = depth_image(depth, "depth");
    return give(unlocked(pixels(view), [&] { return depth_edges(view, gap, slope); }));
}

Array<double> depth_histogram_arrays(const Array<float>& depth, const Bytes& mask, double near, double far,
                                     int levels) {
    const auto view = depth_image(depth, "depth");
    const auto under = mask_image(mask, "mask");
    const DepthLevels range{near, far, levels};
    return give(unlocked(pixels(view), [&] { return depth_histogram(view, under, range); }));
}

Bytes depth_picture_arrays(const Array<float>& depth, double z, double reach) {
    const auto view = depth_image(depth, "depth");
    return give(unlocked(pixels(view), [&] { return depth_picture(view, z, reach); }));
}

using SampleGridTuple = Tuple<double, double, double, int, int>;
using TargetTuple = Tuple<double, double, double>;

std::tuple<Array<float>, Bytes> depth_posterior_arrays(const Array<float>& depth, const SampleGridTuple& grid,
                                                       const TargetTuple& target) {
    const auto view = depth_image(depth, "depth");
    const auto squares = unpack_as<SampleGrid>(grid, "grid");
    const auto depths = unpack_as<ExpectedDepth>(target, "target");
    auto found = unlocked(work_of(squares.rows, squares.columns),
                          [&] { return depth_posterior(view, squares, depths); });
    return {give(std::move(found.posterior)), give(std::move(found.nearer))};
}

Bytes divide_depth_arrays(const Array<float>& depth, const Bytes& mask, const Array<double>& dividers) {
    const auto view = depth_image(depth, "depth");
    const auto under = mask_image(mask, "mask");
    const auto limits = vector(dividers, "dividers");
    return give(unlocked(pixels(view), [&] { return divide_depth(view, under, limits); }));
}

Array<float> fill_gaps_arrays(const Array<float>& depth, double gap, double slope, double max_gap_share,
                              int passes) {
    const auto view = depth_image(depth, "depth");
    return give(unlocked(pixels(view), [&] { return fill_gaps(view, gap, slope, max_gap_share, passes); }));
}

std::tuple<Array<float>, Array<double>, RegionTuple> find_foreground_arrays(
    const Array<float>& depth, int step, std::tuple<double, double, double, int> gaps,
    const Array<double>& camera, const Array<double>& plane, std::pair<double, int> floor,
    std::tuple<double, double, double> space, double margin) {
    const auto view = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto ground = vector(plane, "plane");
    const auto [gap, slope, max_gap_share, passes] = gaps;
    const Gaps filled{gap, slope, max_gap_share, passes};
    const auto [near, far, clear] = space;
    const Space within{near, far, clear};
    auto found = unlocked(pixels(view), [&] {
        return find_foreground(view, step, filled, lens, ground, {floor.first, floor.second}, within, margin);
    });
    return {give(std::move(found.depth)), give(std::move(found.support)), tuple_of(found.measured)};
}

Eigen::Map<const Triples> index_triples(const Array<std::int64_t>& triples) {
    const char* expected = "int64 triples (K, 3)";
    const auto array = require<std::int64_t>(triples, "triples", 2, expected);
    if (array.shape(1) != 3)
        throw py::value_error(std::string("triples: expected ") + expected + ", got " + describe(array));
    return {contiguous<std::int64_t>(array, "triples"), array.shape(0), 3};
}

Array<double> floor_plane_arrays(const Array<float>& depth, const Array<double>& camera,
                                 const Array<std::int64_t>& triples, double tolerance,
                                 const Array<double>& up, double min_cosine) {
    const auto view = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto draws = index_triples(triples);
    const auto upward = vector(up, "up");
    return give(unlocked(work_of(draws.rows(), pixels(view)),
                         [&] { return floor_plane(view, lens, draws, tolerance, {upward, min_cosine}); }));
}

Array<float> above_floor_arrays(const Array<float>& depth, const Array<double>& camera,
                                const Array<double>& plane, double near, double far, double clear) {
    const auto view = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto floor = vector(plane, "plane");
    return give(unlocked(pixels(view), [&] { return above_floor(view, lens, floor, {near, far, clear}); }));
}

Array<float> ground_distance_arrays(const Array<float>& depth, const Array<double>& camera,
                                    const Array<double>& up, double near, double far) {
    const auto view = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto upward = vector(up, "up");
    return give(unlocked(pixels(view), [&] { return ground_distance(view, lens, upward, near, far); }));
}

Array<double> median_depths_arrays(const Array<float>& depth, const Array<double>& boxes, int samples,
                                   double expected, double max_offset, double min_share) {
    const auto view = depth_image(depth, "depth");
    const auto each = states(boxes, "boxes");
    return give(unlocked(work_of(each.rows(), samples, samples), [&] {
        return median_depths(view, each, samples, {expected, max_offset, min_share});
    }));
}

Array<double> plane_support_arrays(const Array<float>& depth, const Array<double>& camera,
                                   const Array<double>& plane, double tolerance, int step) {
    const auto view = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto floor = vector(plane, "plane");
    return give(unlocked(pixels(view) / std::max(1, step) / std::max(1, step),
                         [&] { return plane_support(view, lens, floor, tolerance, step); }));
}

Bytes support_pixels_arrays(const Array<float>& depth, const SampleGridTuple& grid, const TargetTuple& target,
                            const Array<double>& camera, const Array<double>& draws, double tolerance) {
    const auto view = depth_image(depth, "depth");
    const auto squares = unpack_as<SampleGrid>(grid, "grid");
    const auto supported = unpack_as<SupportedTarget>(target, "target");
    const auto lens = vector(camera, "camera");
    const auto random = states(draws, "draws");
    return give(unlocked(work_of(squares.rows, squares.columns),
                         [&] { return support_pixels(view, squares, supported, lens, random, tolerance); }));
}

}  // namespace

void define_depth(py::module_& m) {
    m.def("above_floor", above_floor_arrays, py::arg("depth"), py::arg("camera"), py::arg("plane"),
          py::arg("near"), py::arg("far"), py::arg("clear"), docs::above_floor);
    m.def("changed_depth", changed_depth_arrays, py::arg("depth"), py::arg("before"), py::arg("noise"),
          py::arg("slope"), docs::changed_depth);
    m.def("remember_depth", remember_depth_arrays, py::arg("depth"), py::arg("before"), py::arg("region"),
          py::arg("z"), py::arg("reach"), docs::remember_depth);
    m.def("depth_edges", depth_edges_arrays, py::arg("depth"), py::arg("gap"), py::arg("slope"),
          docs::depth_edges);
    m.def("depth_histogram", depth_histogram_arrays, py::arg("depth"), py::arg("mask"), py::arg("near"),
          py::arg("far"), py::arg("levels"), docs::depth_histogram);
    m.def("depth_picture", depth_picture_arrays, py::arg("depth"), py::arg("z"), py::arg("reach"),
          docs::depth_picture);
    m.def("depth_posterior", depth_posterior_arrays, py::arg("depth"), py::arg("grid"), py::arg("target"),
          docs::depth_posterior);
    m.def("divide_depth", divide_depth_arrays, py::arg("depth"), py::arg("mask"), py::arg("dividers"),
          docs::divide_depth);
    m.def("find_foreground", find_foreground_arrays, py::arg("depth"), py::arg("step"), py::arg("gaps"),
          py::arg("camera"), py::arg("plane"), py::arg("floor"), py::arg("space"), py::arg("margin"),
          docs::find_foreground);
    m.def("fill_gaps", fill_gaps_arrays, py::arg("depth"), py::arg("gap"), py::arg("slope"),
          py::arg("max_gap_share"), py::arg("passes"), docs::fill_gaps);
    m.def("floor_plane", floor_plane_arrays, py::arg("depth"), py::arg("camera"), py::arg("triples"),
          py::arg("tolerance"), py::arg("up"), py::arg("min_cosine"), docs::floor_plane);
    m.def("ground_distance", ground_distance_arrays, py::arg("depth"), py::arg("camera"), py::arg("up"),
          py::arg("near"), py::arg("far"), docs::ground_distance);
    m.def("median_depths", median_depths_arrays, py::arg("depth"), py::arg("boxes"), py::arg("samples"),
          py::arg("expected"), py::arg("max_offset"), py::arg("min_share"), docs::median_depths);
    m.def("plane_support", plane_support_arrays, py::arg("depth"), py::arg("camera"), py::arg("plane"),
          py::arg("tolerance"), py::arg("step"), docs::plane_support);
    m.def("support_pixels", support_pixels_arrays, py::arg("depth"), py::arg("grid"), py::arg("target"),
          py::arg("camera"), py::arg("draws"), py::arg("tolerance"), docs::support_pixels);
}

}  // namespace tricue::bindings
