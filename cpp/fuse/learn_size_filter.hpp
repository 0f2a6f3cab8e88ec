// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/stack_view.hpp"
#include "cues/color/pick_pixels.hpp"
#include "fuse/correlation_train.hpp"

namespace tricue {

/// A correlation filter as correlation_train takes it.
struct FilterParts {
    ComplexStack numerator;  ///< complex64 (K, R, C // 2 + 1), A
    FloatsRef denominator;   ///< float32 (R, C // 2 + 1), B
};

/// The filter of a target's size: as it is learned, and as it is applied.
struct SizeFilter {
    CorrelationFilter learned;
    Complexes applied;  ///< complex64 (1, K, R, C // 2 + 1); in C++ the planes one below the other
};

/// Learns the filter of a target's size from a patch: one stage of the frame, in one call. It is pick_pixels, hog_color_cells and
/// correlation_train; then the parts are blended with those of the first frame, against forgetting, and divided:
///     A = learned + first_weight (first - learned), B alike;   applied = A / (B + ridge mean(B))
///
/// `learned` are A and B so far, as correlation_train takes them, `first` those of the first frame; K is 19. mean(B) counts as at
/// least 1e-12.
///
/// @param patch uint8 (H, W, 3) BGR, without padding between its rows
/// @param places int64 (2R, 2C): as pick_pixels takes them
/// @param taper float32 (R, C)
/// @param label as correlation_train takes it
/// @param rate as correlation_train takes it
/// @param first_weight in [0, 1]
/// @param ridge finite, above 0
/// @returns learned (numerator, denominator), A and B
/// @returns applied complex64 (1, K, R, C // 2 + 1)
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST); Li, Zhu, Hoi, Song, Wang, Liu 2019 (LDES).
SizeFilter learn_size_filter(const ImageView& patch, PlacesRef places, FloatsRef taper, ComplexesRef label,
                             const FilterParts& learned, const FilterParts& first, double rate,
                             double first_weight, double ridge);

}  // namespace tricue
