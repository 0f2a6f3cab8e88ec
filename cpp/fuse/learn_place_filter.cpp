// SPDX-License-Identifier: MIT
#include "fuse/learn_place_filter.hpp"

#include <algorithm>
#include <utility>

#include "cues/color/hog_color_cells.hpp"
#include "fuse/detail/blend_filters.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/regularized_filter.hpp"

namespace tricue {

PlaceFilter learn_place_filter(const ImageView& patch, FloatsRef taper, FloatsRef mask, ComplexesRef label,
                               const ComplexStack& previous, const ComplexStack& first,
                               double temporal_weight, double penalty, double first_weight) {
    const FloatPlanes numbers = hog_color_cells(patch, taper);
    const FloatStack cells = numbers.view();
    require_filter("first", first, cells);
    require_share_of_first(first_weight);
    Complexes learned = regularized_filter(cells, mask, label, previous, temporal_weight, penalty);
    Complexes applied(2 * learned.rows(), learned.cols());
    blend_filters(learned.data(), first.data, static_cast<float>(first_weight), learned.size(),
                  applied.data());
    std::copy_n(first.data, learned.size(), applied.data() + learned.size());
    return {std::move(learned), std::move(applied)};
}

}  // namespace tricue
