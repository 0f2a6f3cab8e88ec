// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <optional>

#include "arrays.hpp"
#include "camera/back_project.hpp"
#include "camera/rectify_verged.hpp"
#include "camera/reduce_gray.hpp"
#include "color_space.hpp"
#include "cues/stereo/ellipse_disparity.hpp"
#include "cues/stereo/gradient_disparity.hpp"
#include "cues/stereo/head_cells.hpp"
#include "cues/stereo/sad_disparity.hpp"
#include "kernel_docs.hpp"
#include "tuples.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;
using DisparityRangeTuple = Tuple<int, int>;
using MatchingTuple = Tuple<int, int, bool>;

Array<float> sad_disparity_arrays(const Bytes& left, const Bytes& right, const RegionTuple& region,
                                  bool ellipse, const DisparityRangeTuple& limits,
                                  const MatchingTuple& matching, int tolerance) {
    const auto view = gray_image(left, "left"), other = gray_image(right, "right");
    const StereoRegion part{region_of(region), ellipse};
    const auto range = unpack_as<DisparityRange>(limits, "limits");
    const auto how = unpack_as<StereoMatching>(matching, "matching");
    return give(unlocked(work_in(part.place),
                         [&] { return sad_disparity(view, other, part, range, how, tolerance); }));
}

/// Variances (3,) as one row of 3, covariances (N, 3, 3) as rows of 9.
Eigen::Map<const States> variance_rows(const Array<double>& object) {
    const char* expected = "float64 variances (3,) or covariances (N, 3, 3)";
    const bool single = py::isinstance<py::array>(object) && py::cast<py::array>(object).ndim() == 1;
    const auto array = require<double>(object, "variances", single ? 1 : 3, expected);
    const auto size = array.shape(array.ndim() - 1);
    if (size != 3 || array.shape(array.ndim() - (single ? 1 : 2)) != 3)
        throw py::value_error(std::string("variances: expected ") + expected + ", got " + describe(array));
    return {contiguous<double>(array, "variances"), single ? 1 : array.shape(0), single ? 3 : 9};
}

std::tuple<Array<double>, Array<double>> back_project_arrays(const Array<double>& measurements,
                                                             const Array<double>& variances,
                                                             const Array<double>& camera, double baseline) {
    const auto pixels = states(measurements, "measurements");
    const auto noises = variance_rows(variances);
    const auto lens = vector(camera, "camera");
    auto result = unlocked(9 * pixels.size(), [&] { return back_project(pixels, noises, lens, baseline); });
    const auto count = static_cast<py::ssize_t>(pixels.rows());
    return {give(std::move(result.points)), give(std::move(result.covariances), {count, 3, 3})};
}

using Point = std::tuple<double, double>;

std::tuple<Array<float>, Array<float>> gradient_disparity_arrays(
    const Bytes& left, const Bytes& right, double disparity,
    const Tuple<int, double, int, double, double, double>& matching,
    const std::optional<Tuple<int, int, int, int>>& region) {
    const auto view = gray_image(left, "left"), other = gray_image(right, "right");
    const auto how = unpack_as<GradientMatching>(matching, "matching");
    const Region part = region ? unpack_as<Region>(*region, "region") : Region{0, 0, view.cols, view.rows};
    auto found =
        unlocked(work_in(part), [&] { return gradient_disparity(view, other, disparity, how, part); });
    const std::vector<py::ssize_t> shape{2, found.rows() / 2, found.cols()};
    const py::object both = give(std::move(found), shape);
    return {both[py::int_(0)], both[py::int_(1)]};
}

Bytes rectify_verged_arrays(const Bytes& right, double angle, double focal,
                            const std::optional<Point>& center, double shift, bool rows_only) {
    const auto view = any_image(right, "right");
    const auto [cx, cy] = center.value_or(Point{(view.cols - 1) / 2.0, (view.rows - 1) / 2.0});
    const VergedCamera camera{angle, focal, cx, cy};
    auto turned = unlocked(std::ptrdiff_t{view.rows} * view.cols,
                           [&] { return rectify_verged(view, camera, shift, rows_only); });
    std::vector<py::ssize_t> shape{view.rows, view.cols};
    if (view.channels == 3) shape.push_back(3);
    return give(std::move(turned), shape);
}

Bytes reduce_gray_arrays(const Bytes& image, int step, const std::optional<RegionTuple>& region) {
    const auto view = any_image(image, "image");
    const auto part = region_of(region);
    const auto work = part ? work_in(*part, step, step) : std::ptrdiff_t{view.rows} * view.cols;
    return give(unlocked(work, [&] { return reduce_gray(view, step, part); }));
}

using Gains = std::tuple<double, double, double>;

std::tuple<Array<std::uint16_t>, Bytes> head_cells_arrays(
    const Bytes& left, const Bytes& right, const RegionTuple& region, int step, const SpaceTuple& space,
    const std::optional<Gains>& gains, const Tuple<double, double, int>& depth,
    const DisparityRangeTuple& limits, const MatchingTuple& matching) {
    const auto view = color_image(left, "left"), other = any_image(right, "right");
    const Region part = region_of(region);
    const ColorSpace colors = color_space(space);
    std::array<double, 3> given{};
    if (gains) given = {std::get<0>(*gains), std::get<1>(*gains), std::get<2>(*gains)};
    const auto [expected, tolerance, fill] = unpack(depth, "depth");
    const HeadDepth head{static_cast<float>(expected), static_cast<float>(tolerance), fill};
    const auto range = unpack_as<DisparityRange>(limits, "limits");
    const auto how = unpack_as<StereoMatching>(matching, "matching");
    auto cells = unlocked(work_in(part, step), [&] {
        return head_cells(view, other, part, step, colors, gains ? &given : nullptr, head, range, how);
    });
    return {give(std::move(cells.bins)), give(std::move(cells.coherent))};
}

std::tuple<double, int, int> ellipse_disparity_arrays(const Bytes& left, const Bytes& right,
                                                      const Array<double>& ellipse,
                                                      const DisparityRangeTuple& limits,
                                                      const MatchingTuple& matching,
                                                      const Tuple<bool, bool, double>& statistic) {
    const auto view = any_image(left, "left"), other = any_image(right, "right");
    const auto where = vector(ellipse, "ellipse");
    const auto range = unpack_as<DisparityRange>(limits, "limits");
    const auto how = unpack_as<StereoMatching>(matching, "matching");
    const auto [subpixel, median, tolerance] = unpack(statistic, "statistic");
    const DisparityStatistic by{subpixel, median, static_cast<float>(tolerance)};
    const bool known = where.size() == 4 && where.allFinite();
    const auto found = unlocked(known ? work_of(2 * where[2], 2 * where[3]) : 0,
                                [&] { return ellipse_disparity(view, other, where, range, how, by); });
    return {found.disparity, found.matched, found.near};
}

}  // namespace

void define_stereo(py::module_& m) {
    m.def("sad_disparity", sad_disparity_arrays, py::arg("left"), py::arg("right"), py::arg("region"),
          py::arg("ellipse"), py::arg("limits"), py::arg("matching"), py::arg("tolerance") = -1,
          docs::sad_disparity);
    m.def("back_project", back_project_arrays, py::arg("measurements"), py::arg("variances"),
          py::arg("camera"), py::arg("baseline"), docs::back_project);
    m.def("gradient_disparity", gradient_disparity_arrays, py::arg("left"), py::arg("right"),
          py::arg("disparity"), py::arg("matching"), py::arg("region") = py::none(),
          docs::gradient_disparity);
    m.def("rectify_verged", rectify_verged_arrays, py::arg("right"), py::arg("angle"), py::arg("focal"),
          py::arg("center") = py::none(), py::arg("shift") = 0.0, py::arg("rows_only") = false,
          docs::rectify_verged);
    m.def("reduce_gray", reduce_gray_arrays, py::arg("image"), py::arg("step"),
          py::arg("region") = py::none(), docs::reduce_gray);
    m.def("head_cells", head_cells_arrays, py::arg("left"), py::arg("right"), py::arg("region"),
          py::arg("step"), py::arg("space"), py::arg("gains"), py::arg("depth"), py::arg("limits"),
          py::arg("matching"), docs::head_cells);
    m.def("ellipse_disparity", ellipse_disparity_arrays, py::arg("left"), py::arg("right"),
          py::arg("ellipse"), py::arg("limits"), py::arg("matching"), py::arg("statistic"),
          docs::ellipse_disparity);
}

}  // namespace tricue::bindings
