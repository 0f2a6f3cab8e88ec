// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace tricue {

/// Particles, one per row: an ellipse (x, y, minor, major) or another state of D numbers. Rows are contiguous.
using States = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using StatesRef = Eigen::Ref<const States>;
using Vector = Eigen::Array<double, Eigen::Dynamic, 1>;
using VectorRef = Eigen::Ref<const Vector>;
using Indices = Eigen::Array<std::int64_t, Eigen::Dynamic, 1>;

/// Measurements of N ellipses, one per row, contiguous.
using Floats = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using FloatsRef = Eigen::Ref<const Floats>;

}  // namespace tricue
