// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// The filter of a target's place: as it is learned, and as it is applied.
struct PlaceFilter {
    Complexes learned;  ///< complex64 (K, R, C // 2 + 1); in C++ the planes one below the other
    /// complex64 (2, K, R, C // 2 + 1): the learned one with a share of the first, and the first
    Complexes applied;
};

/// Learns the filter of a target's place from a patch: one stage of the frame, in one call. It is hog_color_cells, then
/// regularized_filter, whose result is also blended with the first frame's filter, against forgetting:
///     applied = learned + first_weight (first - learned)
///
/// @param patch uint8 (2R, 2C, 3) BGR, the target in its middle
/// @param taper float32 (R, C)
/// @param mask, label, previous as regularized_filter takes them; K is 19
/// @param first complex64 (K, R, C // 2 + 1), of the first frame
/// @param temporal_weight, penalty as regularized_filter takes them
/// @param first_weight in [0, 1]
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: Li, Tian, Zuo, Zhang, Yang 2018 (STRCF).
PlaceFilter learn_place_filter(const ImageView& patch, FloatsRef taper, FloatsRef mask, ComplexesRef label,
                               const ComplexStack& previous, const ComplexStack& first,
                               double temporal_weight, double penalty, double first_weight);

}  // namespace tricue
