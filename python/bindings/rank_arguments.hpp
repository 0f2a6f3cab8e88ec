// SPDX-License-Identifier: MIT
#pragma once
// The arguments that the kernels on color ranks share.

#include "arrays.hpp"
#include "cues/color/rank_likelihood.hpp"
#include "tuples.hpp"

namespace tricue::bindings {

using PatternTuple = Tuple<Array<double>, Array<double>>;
using AppearanceTuple = Tuple<Array<float>, Array<double>, bool, Array<float>>;
using FactorsTuple = Tuple<double, double>;

inline EllipsePattern ellipse_pattern(const PatternTuple& pattern) {
    const auto [inside, around] = unpack(pattern, "pattern");
    return {states(inside, "inside"), states(around, "around")};
}

/// Of rank maps over so many places.
inline ColorAppearance color_appearance(const AppearanceTuple& appearance, py::ssize_t places) {
    const auto [models, shares, nearest, table] = unpack(appearance, "appearance");
    return {rank_maps(models, places), vector(shares, "shares"), nearest, color_cube(table)};
}

inline LikelihoodFactors likelihood_factors(const FactorsTuple& factors) {
    const auto [sharpness, contrast_weight] = unpack(factors, "factors");
    return {sharpness, contrast_weight};
}

}  // namespace tricue::bindings
