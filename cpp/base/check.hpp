// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>

#include "base/arrays.hpp"
#include "base/region.hpp"

namespace tricue {

constexpr int kMaxImageSide = 16384;  ///< pixels, of an image that a kernel creates

/// Each check throws std::invalid_argument with the argument's name, what was expected and what was given.
void require_share(double share);
void require_positive(double value, const char* name);      ///< and finite
void require_not_negative(double value, const char* name);  ///< and finite
void require_count(int count, int least, int most, const char* name);
void require_rows(Eigen::Index rows, Eigen::Index count, const char* name);
void require_size(VectorRef values, Eigen::Index size, const char* name);
void require_shape(StatesRef values, Eigen::Index rows, Eigen::Index cols, const char* name);
void require_shape(Eigen::Index rows, Eigen::Index cols, Eigen::Index expected_rows,
                   Eigen::Index expected_cols, const char* name);
void require_finite(VectorRef values, const char* name);
void require_finite(StatesRef values, const char* name);
void require_region(const Region& region, int rows, int cols);  ///< corners in order, within an image

/// For two views of images, planes or bins.
template <typename Values, typename Other>
void require_same_shape(const Values& values, const Other& other, const char* name) {
    require_shape(values.rows, values.cols, other.rows, other.cols, name);
}

/// Square, finite, without negative variances, and symmetric within 1e-9 of its largest variance.
void require_covariance(StatesRef values, Eigen::Index size, const char* name);

/// Returns the sum of weights that are finite, not negative, and have a finite sum above 0.
double require_weights(VectorRef weights);

[[noreturn]] void refuse(const char* name, const std::string& expected, const std::string& got);
[[noreturn]] void refuse(const char* name, const std::string& expected, double got);

/// A whole number with all its digits.
template <typename Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
[[noreturn]] void refuse(const char* name, const std::string& expected, Integer got) {
    refuse(name, expected, std::to_string(got));
}

/// "(rows, cols)", for messages.
std::string shape_text(Eigen::Index rows, Eigen::Index cols);

}  // namespace tricue
