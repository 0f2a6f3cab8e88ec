// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>

namespace tricue {

/// A non-owning, read-only view of contiguous planes of the same size; by default one follows the other.
template <typename Scalar>
struct StackView {
    const Scalar* data;
    int planes, rows, cols;
    std::ptrdiff_t pitch = std::ptrdiff_t{rows} * cols;  ///< numbers from a plane to the next

    const Scalar* row(int plane, int y) const { return data + plane * pitch + std::ptrdiff_t{y} * cols; }
};

using FloatStack = StackView<float>;
using ComplexStack = StackView<std::complex<float>>;

/// A non-owning, read-only view of the spectra of several filters, C-contiguous (filters, planes, rows, cols).
struct FilterStack {
    const std::complex<float>* data;
    int filters, planes, rows, cols;

    const std::complex<float>* plane(int filter, int plane) const {
        return data + (std::ptrdiff_t{filter} * planes + plane) * (std::ptrdiff_t{rows} * cols);
    }
};

/// Spectra, contiguous; a row holds one frequency along y.
using Complexes = Eigen::Array<std::complex<float>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ComplexesRef = Eigen::Ref<const Complexes>;

}  // namespace tricue
