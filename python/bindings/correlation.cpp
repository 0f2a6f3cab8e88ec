// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "fuse/correlation_response.hpp"
#include "fuse/correlation_train.hpp"
#include "fuse/evidence_peak.hpp"
#include "fuse/regularized_filter.hpp"
#include "kernel_docs.hpp"
#include "spectra.hpp"

namespace tricue::bindings {
namespace {

constexpr const char* kCells = "float32 cells (K, R, C)";
constexpr const char* kPlane = "float32 (R, C)";

std::ptrdiff_t work(const FloatStack& cells) {
    return std::ptrdiff_t{cells.planes} * cells.rows * cells.cols;
}

Floating correlation_response_arrays(const Floating& cells, const Complex& filters) {
    const auto planes = stack<float>(cells, "cells", kCells);
    const auto each = filter_stack(filters, "filters");
    return give(unlocked(work(planes), [&] { return correlation_response(planes, each); }),
                {each.filters, planes.rows, planes.cols});
}

std::tuple<Complex, Floating> correlation_train_arrays(const Floating& cells, const Complex& label,
                                                       const Complex& numerator, const Floating& denominator,
                                                       double rate) {
    const auto planes = stack<float>(cells, "cells", kCells);
    const auto wanted = complexes(label, "label", kSpectrum);
    const auto upper = stack<std::complex<float>>(numerator, "numerator", kFilter);
    const auto lower = floats(denominator, "denominator", {-1, -1}, kHalf);
    auto filter =
        unlocked(work(planes), [&] { return correlation_train(planes, wanted, upper, lower, rate); });
    return {give(std::move(filter.numerator), {upper.planes, upper.rows, upper.cols}),
            give(std::move(filter.denominator))};
}

Complex regularized_filter_arrays(const Floating& cells, const Floating& mask, const Complex& label,
                                  const Complex& previous, double temporal_weight, double penalty) {
    const auto planes = stack<float>(cells, "cells", kCells);
    const auto part = floats(mask, "mask", {-1, -1}, kPlane);
    const auto wanted = complexes(label, "label", kSpectrum);
    const auto old = stack<std::complex<float>>(previous, "previous", kFilter);
    auto filter = unlocked(work(planes), [&] {
        return regularized_filter(planes, part, wanted, old, temporal_weight, penalty);
    });
    return give(std::move(filter), {old.planes, old.rows, old.cols});
}

Array<double> evidence_peak_arrays(const Floating& responses, const Floating& contrast, double filter_weight,
                                   double contrast_weight) {
    const auto planes = stack<float>(responses, "responses", "float32 responses (F, R, C)");
    const auto other = floats(contrast, "contrast", {-1, -1}, kPlane);
    return give(unlocked(work(planes),
                         [&] { return evidence_peak(planes, other, {filter_weight, contrast_weight}); }));
}

}  // namespace

void define_correlation(py::module_& m) {
    m.def("correlation_response", correlation_response_arrays, py::arg("cells"), py::arg("filters"),
          docs::correlation_response);
    m.def("correlation_train", correlation_train_arrays, py::arg("cells"), py::arg("label"),
          py::arg("numerator"), py::arg("denominator"), py::arg("rate"), docs::correlation_train);
    m.def("evidence_peak", evidence_peak_arrays, py::arg("responses"), py::arg("contrast"),
          py::arg("filter_weight"), py::arg("contrast_weight"), docs::evidence_peak);
    m.def("regularized_filter", regularized_filter_arrays, py::arg("cells"), py::arg("mask"),
          py::arg("label"), py::arg("previous"), py::arg("temporal_weight"), py::arg("penalty"),
          docs::regularized_filter);
}

}  // namespace tricue::bindings
