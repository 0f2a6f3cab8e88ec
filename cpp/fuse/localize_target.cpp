// SPDX-License-Identifier: MIT
#include "fuse/localize_target.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/color_cells.hpp"
#include "base/simd.hpp"
#include "cues/color/box_contrast.hpp"
#include "cues/color/color_posterior.hpp"
#include "cues/color/hog_color_cells.hpp"
#include "fuse/combine_posteriors.hpp"
#include "fuse/correlation_response.hpp"
#include "fuse/evidence_peak.hpp"

namespace tricue {
namespace {

constexpr double kCellPixels = 2.0;  // patch pixels on a side of a cell of hog_color_cells
// The index, in what evidence_peak returns, of the first filter's greatest response near the place.
constexpr Eigen::Index kGreatestResponse = 5;
constexpr double kMinDeviation = 1e-6;  // for a response that is the same everywhere

/// Pixels from `first` to before `end`.
struct Span {
    int first, end;

    int size() const { return end - first; }
};

PlaneView view(const Floats& plane) {
    return {plane.data(), static_cast<int>(plane.rows()), static_cast<int>(plane.cols()), plane.cols()};
}

/// The contrast of the posterior between the target's box and its surround; empty if there is no posterior.
Floats find_contrast(const ImageView& patch, FloatsRef table, const PlaneView& other,
                     const TargetSearch& search) {
    const SurroundedBox box{search.width, search.height, search.surround_size};
    if (table.size() == 0)
        return other.rows == 0 ? Floats() : box_contrast(other, box, search.surround_weight);
    Floats posterior = color_posterior(patch, table);
    if (other.rows > 0) posterior = combine_posteriors(view(posterior), other);
    return box_contrast(view(posterior), box, search.surround_weight);
}

using Four = Pack<double, 4>;

double peak_sharpness(const float* response, Eigen::Index count, double peak) {
    Four sums = {}, squares = {};
    Eigen::Index i = 0;
    for (; i + 4 <= count; i += 4) {
        const Four each = {response[i], response[i + 1], response[i + 2], response[i + 3]};
        sums += each;
        squares += each * each;
    }
    double total = sum(sums), energy = sum(squares);
    for (; i < count; ++i) {
        const double each = response[i];
        total += each;
        energy += each * each;
    }
    const double mean = total / static_cast<double>(count), power = energy / static_cast<double>(count);
    return (peak - mean) / std::max(std::sqrt(std::max(power - mean * mean, 0.0)), kMinDeviation);
}

Span find_span(double center, double length, int size) {
    const double last = size - 1.0, end = size;
    const double first = std::min(std::max(std::nearbyint(center - length / 2), 0.0), last);
    return {static_cast<int>(first),
            static_cast<int>(std::max(std::min(std::nearbyint(center + length / 2), end), first + 1))};
}

int bits_of(VectorRef roots) {
    for (int bits = 0; bits <= 6; ++bits)
        if (roots.size() == Eigen::Index{1} << (3 * bits)) return bits;
    refuse("roots", "(B³,), B a power of two up to 64", std::to_string(roots.size()));
}

/// The Bhattacharyya coefficient between the colors around a place and the histogram whose square roots are `roots`.
double color_similarity(const ImageView& patch, VectorRef roots, int bits, double right, double down,
                        const TargetSearch& search) {
    const Span rows = find_span(patch.rows / 2.0 + down, search.inner * search.height, patch.rows),
               columns = find_span(patch.cols / 2.0 + right, search.inner * search.width, patch.cols);
    std::vector<std::int32_t> counts(static_cast<std::size_t>(roots.size())),
        cells(static_cast<std::size_t>(columns.size()));
    for (int y = rows.first; y < rows.end; ++y) {
        pixel_cells(patch.row(y) + 3 * std::ptrdiff_t{columns.first}, columns.size(), bits, cells.data());
        for (const std::int32_t cell : cells) ++counts[static_cast<std::size_t>(cell)];
    }
    const auto pixels = static_cast<float>(std::ptrdiff_t{rows.size()} * columns.size());
    double sum = 0.0;
    for (Eigen::Index i = 0; i < roots.size(); ++i)
        if (const std::int32_t count = counts[static_cast<std::size_t>(i)]; count > 0)
            sum += std::sqrt(double{static_cast<float>(count) / pixels}) * roots[i];
    return sum;
}

void require_arguments(const ImageView& patch, const PlaneView& other, const TargetSearch& search) {
    if (other.rows > 0 && (other.rows != patch.rows || other.cols != patch.cols))
        refuse("other", "the patch's rows and columns",
               std::to_string(other.rows) + ", " + std::to_string(other.cols));
    for (const auto& [name, number] :
         {std::pair{"width", search.width}, {"height", search.height}, {"inner", search.inner}})
        require_positive(number, name);
}

}  // namespace

LocalizedTarget localize_target(const ImageView& patch, FloatsRef taper, const TargetAppearance& appearance,
                                const PlaneView& other, const TargetSearch& search) {
    require_arguments(patch, other, search);
    const int bits = bits_of(appearance.roots);
    const FloatPlanes cells = hog_color_cells(patch, taper);
    const int rows = static_cast<int>(taper.rows()), cols = static_cast<int>(taper.cols()),
              filters = appearance.filters.filters;
    Floats responses = correlation_response(cells.view(), appearance.filters);
    const Vector peak = evidence_peak({responses.data(), filters, rows, cols},
                                      find_contrast(patch, appearance.table, other, search),
                                      {search.filter_weight, search.contrast_weight});
    Vector found(peak.size() + 2);
    found.head(peak.size()) = peak;
    found[peak.size()] = peak_sharpness(responses.data(), taper.size(), peak[kGreatestResponse]);
    found[peak.size() + 1] =
        color_similarity(patch, appearance.roots, bits, kCellPixels * peak[0], kCellPixels * peak[1], search);
    return {std::move(found), std::move(responses)};
}

}  // namespace tricue
