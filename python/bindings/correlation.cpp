// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "fuse/correlation_response.hpp"
#include "fuse/correlation_train.hpp"
#include "fuse/scale_response.hpp"
#include "fuse/scale_train.hpp"

namespace tricue::bindings {
namespace {

using Floating = Array<float>;
using Complex = Array<std::complex<float>>;

constexpr const char* kCells = "float32 cells (K, R, C)";
constexpr const char* kNumerator = "complex64 (K, R, C // 2 + 1)";
constexpr const char* kHalf = "float32 (R, C // 2 + 1)";

std::ptrdiff_t work(const FloatStack& cells) {
    return std::ptrdiff_t{cells.planes} * cells.rows * cells.cols;
}

Floating correlation_response_arrays(const Floating& cells, const Complex& numerator,
                                     const Floating& denominator, double ridge) {
    const auto planes = stack<float>(cells, "cells", kCells);
    const auto upper = stack<std::complex<float>>(numerator, "numerator", kNumerator);
    const auto lower = floats(denominator, "denominator", {-1, -1}, kHalf);
    return give(unlocked(work(planes), [&] { return correlation_response(planes, upper, lower, ridge); }));
}

std::tuple<Complex, Floating> correlation_train_arrays(const Floating& cells, const Floating& focus,
                                                       const Complex& label, const Complex& numerator,
                                                       const Floating& denominator, double rate,
                                                       double background) {
    const auto planes = stack<float>(cells, "cells", kCells);
    const auto part = floats(focus, "focus", {-1, -1}, "float32 (R, C)");
    const auto wanted = complexes(label, "label", "complex64 (R, C // 2 + 1)");
    const auto upper = stack<std::complex<float>>(numerator, "numerator", kNumerator);
    const auto lower = floats(denominator, "denominator", {-1, -1}, kHalf);
    auto filter = unlocked(work(planes), [&] {
        return correlation_train(planes, part, wanted, upper, lower, rate, background);
    });
    return {give(std::move(filter.numerator), {upper.planes, upper.rows, upper.cols}),
            give(std::move(filter.denominator))};
}

constexpr const char* kLooks = "float32 looks (S, D)";
constexpr const char* kFrequencies = "complex64 (S, D)";

Floating scale_response_arrays(const Floating& looks, const Complex& numerator, const Floating& denominator,
                               double ridge) {
    const auto seen = floats(looks, "looks", {-1, -1}, kLooks);
    const auto upper = complexes(numerator, "numerator", kFrequencies);
    const auto lower = floats(denominator, "denominator", {-1}, "float32 (S,)");
    return give(unlocked(seen.size(), [&] { return scale_response(seen, upper, lower, ridge); }));
}

std::tuple<Complex, Floating> scale_train_arrays(const Floating& looks, const Complex& label,
                                                 const Complex& numerator, const Floating& denominator,
                                                 double rate) {
    const auto seen = floats(looks, "looks", {-1, -1}, kLooks);
    const auto wanted = require<std::complex<float>>(label, "label", 1, "complex64 (S,)");
    const Eigen::Map<const Complexes> spectrum(contiguous<std::complex<float>>(wanted, "label"), 1,
                                               wanted.shape(0));
    const auto upper = complexes(numerator, "numerator", kFrequencies);
    const auto lower = floats(denominator, "denominator", {-1}, "float32 (S,)");
    auto filter = unlocked(seen.size(), [&] { return scale_train(seen, spectrum, upper, lower, rate); });
    return {give(std::move(filter.numerator)), give(std::move(filter.denominator))};
}

}  // namespace

void define_correlation(py::module_& m) {
    m.def("correlation_response", correlation_response_arrays, py::arg("cells"), py::arg("numerator"),
          py::arg("denominator"), py::arg("ridge"),
          "(R, C), no shift at (R // 2, C // 2): how much cells (K, R, C), shifted, look as those learnt: "
          "equation (6), of the numerator (K, R, C // 2 + 1) and the denominator (R, C // 2 + 1) that "
          "correlation_train makes; lambda is ridge times the denominator's mean.");
    m.def(
        "correlation_train", correlation_train_arrays, py::arg("cells"), py::arg("focus"), py::arg("label"),
        py::arg("numerator"), py::arg("denominator"), py::arg("rate"), py::arg("background"),
        "Numerator (K, R, C // 2 + 1) and denominator (R, C // 2 + 1), equation (5), with cells (K, R, C) "
        "times a focus (R, C) blended in at a rate from 0 to 1, which starts them. The rest adds its energy "
        "to the denominator, background times. label (R, C // 2 + 1) is the spectrum of the wanted answer, "
        "its peak at (0, 0).");
    m.def("scale_response", scale_response_arrays, py::arg("looks"), py::arg("numerator"),
          py::arg("denominator"), py::arg("ridge"),
          "(S,), no change at S // 2: how much the looks (S, D) of a target at S steps of scale, shifted, "
          "are as those learnt: equation (6) along one dimension, of the numerator (S, D) and the "
          "denominator (S,) that scale_train makes; lambda is ridge times the denominator's mean.");
    m.def("scale_train", scale_train_arrays, py::arg("looks"), py::arg("label"), py::arg("numerator"),
          py::arg("denominator"), py::arg("rate"),
          "Numerator (S, D) and denominator (S,), equation (5) along one dimension, with looks (S, D) "
          "blended in at a rate from 0 to 1, which starts them; label (S,) is the spectrum of the wanted "
          "answer, its peak at 0.");
}

}  // namespace tricue::bindings
