// SPDX-License-Identifier: MIT
// Pixel work outside of trackers by the system's OpenCV: pip's cv2 resamples differently from version to version, and with the
// processor.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"

namespace tricue::bindings {
namespace {

constexpr int kMaxChannels = 4;
constexpr int kMaxWindow = 16384;  // pixels, of a window's side: OpenCV takes it as an image of side² bytes
constexpr int kMaxWarped = 32766;  // pixels, of the sides of what OpenCV warps
constexpr const char* kExpected = "a uint8, float32 or float64 image (H, W) or (H, W, C), C from 1 to 4";

/// Shows in signatures as an array of any type: a result has the type of the image.
using Image = py::array;

int depth_of(const py::array& array, const char* name) {
    if (py::isinstance<py::array_t<std::uint8_t>>(array)) return CV_8U;
    if (py::isinstance<py::array_t<float>>(array)) return CV_32F;
    if (py::isinstance<py::array_t<double>>(array)) return CV_64F;
    throw py::type_error(std::string(name) + ": expected " + kExpected + ", got " + describe(array));
}

/// The memory of an array as OpenCV sees it. Pixels are packed, rows maybe padded.
cv::Mat view(const py::array& array, const char* name) {
    const int depth = depth_of(array, name);
    const auto refuse = [&](const std::string& what) {
        throw py::value_error(std::string(name) + ": expected " + what + ", got " + describe(array));
    };
    if (array.ndim() < 2 || array.ndim() > 3 || array.size() == 0) refuse(kExpected);
    const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
    if (channels > kMaxChannels) refuse(kExpected);
    const py::ssize_t pixel = array.itemsize() * channels;
    const bool packed = (channels == 1 || array.strides(2) == array.itemsize()) &&
                        (array.shape(1) == 1 || array.strides(1) == pixel) &&
                        (array.shape(0) == 1 || array.strides(0) >= pixel * array.shape(1));
    if (!packed) refuse("packed pixels, which numpy.ascontiguousarray makes");
    const auto step = array.shape(0) == 1 ? static_cast<std::size_t>(pixel * array.shape(1))
                                          : static_cast<std::size_t>(array.strides(0));
    return {static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)),
            CV_MAKETYPE(depth, static_cast<int>(channels)), const_cast<void*>(array.data()), step};
}

/// An array of the type and channels of an image, in another size, which OpenCV fills.
template <typename Fill>
py::array filled(const py::array& like, int height, int width, Fill&& fill) {
    if (height < 1 || width < 1)
        throw py::value_error("height, width: expected 1 or more, got " + std::to_string(height) + ", " +
                              std::to_string(width));
    std::vector<py::ssize_t> shape{height, width};
    if (like.ndim() == 3) shape.push_back(like.shape(2));
    py::array result(like.dtype(), shape);
    const cv::Mat source = view(like, "image");
    cv::Mat target = view(result, "result");
    const py::gil_scoped_release release;
    fill(source, target);
    return result;
}

template <typename Fill>
py::array filled(const py::array& like, Fill&& fill) {
    view(like, "image");  // which checks the shape before it is read
    return filled(like, static_cast<int>(like.shape(0)), static_cast<int>(like.shape(1)),
                  std::forward<Fill>(fill));
}

using Choices = std::vector<std::pair<const char*, int>>;

int choose(const std::string& value, const char* name, const Choices& choices) {
    std::string names;
    for (const auto& [key, flag] : choices) {
        if (value == key) return flag;
        names += (names.empty() ? "" : ", ") + std::string(key);
    }
    throw py::value_error(std::string(name) + ": expected one of " + names + ", got " + value);
}

int border_of(const std::string& border) {
    return choose(border, "border",
                  {{"constant", cv::BORDER_CONSTANT},
                   {"replicate", cv::BORDER_REPLICATE},
                   {"reflect", cv::BORDER_REFLECT_101},
                   {"wrap", cv::BORDER_WRAP}});
}

int method_of(const std::string& method) {
    return choose(method, "method",
                  {{"nearest", cv::INTER_NEAREST},
                   {"linear", cv::INTER_LINEAR},
                   {"cubic", cv::INTER_CUBIC},
                   {"area", cv::INTER_AREA}});
}

cv::Mat matrix(const Array<double>& object, int rows) {
    const auto array = require<double>(object, "matrix", 2, "a float64 matrix (2, 3) or (3, 3)");
    if (array.shape(0) != rows || array.shape(1) != 3)
        throw py::value_error("matrix: expected (" + std::to_string(rows) + ", 3), got " + describe(array));
    return cv::Mat(rows, 3, CV_64F, const_cast<double*>(contiguous<double>(array, "matrix"))).clone();
}

void require_side(int side) {
    if (side < 1) throw py::value_error("side: expected 1 or more pixels, got " + std::to_string(side));
    if (side > kMaxWindow)
        throw py::value_error("side: expected at most " + std::to_string(kMaxWindow) + " pixels, got " +
                              std::to_string(side));
}

/// A square window; -1 is the anchor in its middle.
cv::Mat square(int side, int anchor) {
    require_side(side);
    if (anchor < -1 || anchor >= side)
        throw py::value_error("anchor: expected a pixel of the square, got " + std::to_string(anchor));
    return cv::Mat::ones(side, side, CV_8U);
}

void require_warped(const py::array& array, const char* name) {
    const cv::Mat seen = view(array, name);
    if (std::max(seen.rows, seen.cols) > kMaxWarped)
        throw py::value_error(std::string(name) + ": expected at most " + std::to_string(kMaxWarped) +
                              " rows and columns, got " + describe(array));
}

py::array resize(const Image& image, int height, int width, const std::string& method) {
    return filled(image, height, width,
                  [&, flag = method_of(method)](const cv::Mat& source, cv::Mat& target) {
                      cv::resize(source, target, target.size(), 0, 0, flag);
                  });
}

py::array gaussian_blur(const Image& image, double sigma, const std::string& border) {
    if (!(sigma > 0)) throw py::value_error("sigma: expected more than 0 pixels");
    return filled(image, [&, flag = border_of(border)](const cv::Mat& source, cv::Mat& target) {
        cv::GaussianBlur(source, target, cv::Size(), sigma, sigma, flag);
    });
}

py::array box_blur(const Image& image, int side) {
    require_side(side);
    return filled(image, [&](const cv::Mat& source, cv::Mat& target) {
        cv::blur(source, target, cv::Size(side, side));
    });
}

py::array erode(const Image& image, int side, int anchor) {
    const cv::Mat window = square(side, anchor);
    return filled(image, [&](const cv::Mat& source, cv::Mat& target) {
        cv::erode(source, target, window, {anchor, anchor});
    });
}

py::array dilate(const Image& image, int side, int anchor) {
    const cv::Mat window = square(side, anchor);
    return filled(image, [&](const cv::Mat& source, cv::Mat& target) {
        cv::dilate(source, target, window, {anchor, anchor});
    });
}

py::array shift(const Image& image, double x, double y, int height, int width, const std::string& method,
                const std::string& border, double value) {
    const cv::Mat moved = (cv::Mat_<double>(2, 3) << 1, 0, x, 0, 1, y);
    const int flag = method_of(method), edge = border_of(border);
    require_warped(image, "image");
    return filled(image, height, width, [&](const cv::Mat& source, cv::Mat& target) {
        cv::warpAffine(source, target, moved, target.size(), flag, edge, cv::Scalar::all(value));
    });
}

py::array warp_perspective(const Image& image, const Array<double>& homography, int height, int width) {
    require_warped(image, "image");
    return filled(image, height, width,
                  [map = matrix(homography, 3)](const cv::Mat& source, cv::Mat& target) {
                      cv::warpPerspective(source, target, map, target.size());
                  });
}

py::array remap(const Image& image, const Array<float>& columns, const Array<float>& rows,
                const std::string& border) {
    const auto x = require<float>(columns, "columns", 2, "float32 (h, w)");
    const auto y = require<float>(rows, "rows", 2, "float32 (h, w)");
    if (x.shape(0) != y.shape(0) || x.shape(1) != y.shape(1))
        throw py::value_error("rows: expected the shape of columns, got " + describe(y));
    require_warped(image, "image");
    require_warped(x, "columns");
    const cv::Mat across = view(x, "columns"), down = view(y, "rows");
    return filled(image, across.rows, across.cols,
                  [&, edge = border_of(border)](const cv::Mat& source, cv::Mat& target) {
                      cv::remap(source, target, across, down, cv::INTER_LINEAR, edge);
                  });
}

void copy_where(const Image& source, const Array<bool>& where, const Image& target) {
    const auto mask = require<bool>(where, "where", 2, "bool (H, W)");
    const py::array mask_bytes = mask.attr("view")("uint8");
    cv::Mat into = view(target, "target");
    const cv::Mat from = view(source, "source"), chosen = view(mask_bytes, "where");
    if (!target.writeable() || from.type() != into.type() || from.size() != into.size() ||
        chosen.size() != into.size())
        throw py::value_error("target: expected a writable image of the source's type and size, got " +
                              describe(target));
    from.copyTo(into, chosen);
}

py::array fill_polygon(const Array<std::int32_t>& points, int height, int width) {
    const char* expected = "int32 points (n, 2): column, row";
    const auto corners = require<std::int32_t>(points, "points", 2, expected);
    if (corners.shape(0) < 1 || corners.shape(1) != 2)
        throw py::value_error("points: expected " + std::string(expected) + ", got " + describe(corners));
    std::vector<cv::Point> polygon;
    const auto at = corners.unchecked<std::int32_t, 2>();
    for (py::ssize_t i = 0; i < at.shape(0); ++i) polygon.emplace_back(at(i, 0), at(i, 1));
    if (height < 1 || width < 1) throw py::value_error("height, width: expected 1 or more");
    py::array result = py::array_t<float>(std::vector<py::ssize_t>{height, width});
    cv::Mat target = view(result, "result");
    target.setTo(0);
    cv::fillPoly(target, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(1));
    return result;
}

py::array convert(const Image& image, int code) {
    const cv::Mat seen = view(image, "image");
    if (seen.channels() != 3 || seen.depth() != CV_32F)
        throw py::value_error("image: expected float32 (H, W, 3), got " + describe(image));
    return filled(image, [&](const cv::Mat& source, cv::Mat& target) { cv::cvtColor(source, target, code); });
}

py::array bgr_to_lab(const Image& image) {
    return convert(image, cv::COLOR_BGR2Lab);
}

py::array lab_to_bgr(const Image& image) {
    return convert(image, cv::COLOR_Lab2BGR);
}

py::array bgr_to_gray(const Array<std::uint8_t>& image) {
    const ImageView color = color_image(image, "image");
    auto result = py::array_t<std::uint8_t>(std::vector<py::ssize_t>{color.rows, color.cols});
    const cv::Mat source = view(py::reinterpret_borrow<py::array>(image), "image");
    cv::Mat target = view(result, "result");
    cv::cvtColor(source, target, cv::COLOR_BGR2GRAY);
    return std::move(result);
}

}  // namespace

void define_imgproc(py::module_& core) {
    // OpenCV would start threads, which kernels don't; it is the system's OpenCV alone that obeys, not pip's cv2.
    cv::setNumThreads(1);
    // No kernels: they have no twins, and no tracker calls them. tricue/imgproc.py says what they do.
    auto imgproc = core.def_submodule("_imgproc");
    using py::arg;
    imgproc.def("resize", &resize, arg("image"), arg("height"), arg("width"), arg("method"));
    imgproc.def("gaussian_blur", &gaussian_blur, arg("image"), arg("sigma"), arg("border"));
    imgproc.def("box_blur", &box_blur, arg("image"), arg("side"));
    imgproc.def("erode", &erode, arg("image"), arg("side"), arg("anchor"));
    imgproc.def("dilate", &dilate, arg("image"), arg("side"), arg("anchor"));
    imgproc.def("shift", &shift, arg("image"), arg("x"), arg("y"), arg("height"), arg("width"), arg("method"),
                arg("border"), arg("value"));
    imgproc.def("warp_perspective", &warp_perspective, arg("image"), arg("matrix"), arg("height"),
                arg("width"));
    imgproc.def("remap", &remap, arg("image"), arg("columns"), arg("rows"), arg("border"));
    imgproc.def("copy_where", &copy_where, arg("source"), arg("where"), arg("target"));
    imgproc.def("fill_polygon", &fill_polygon, arg("points"), arg("height"), arg("width"));
    imgproc.def("bgr_to_lab", &bgr_to_lab, arg("image"));
    imgproc.def("lab_to_bgr", &lab_to_bgr, arg("image"));
    imgproc.def("bgr_to_gray", &bgr_to_gray, arg("image"));
}

}  // namespace tricue::bindings
