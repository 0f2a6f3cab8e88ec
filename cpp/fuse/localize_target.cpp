// SPDX-License-Identifier: MIT
#include "fuse/localize_target.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/box_contrast.hpp"
#include "cues/color/color_posterior.hpp"
#include "cues/color/hog_color_cells.hpp"
#include "cues/color/joint_histogram.hpp"
#include "fuse/combine_posteriors.hpp"
#include "fuse/correlation_response.hpp"
#include "fuse/evidence_peak.hpp"

namespace tricue {
namespace {

constexpr double kLeastDeviation = 1e-6;  // of a response that is the same everywhere

/// Pixels from `first` to before `end`.
struct Span {
    int first, end;

    int size() const { return end - first; }
};

PlaneView view(const Floats& plane) {
    return {plane.data(), static_cast<int>(plane.rows()), static_cast<int>(plane.cols()), plane.cols()};
}

/// How much more of what looks like the target is in its box than around it; without numbers where nothing tells.
Floats find_contrast(const ImageView& patch, FloatsRef table, const PlaneView& other,
                     const TargetSearch& search) {
    const FramedBox box{search.width, search.height, search.outer};
    if (table.size() == 0) return other.rows == 0 ? Floats() : box_contrast(other, box, search.around);
    Floats posterior = color_posterior(patch, table);
    if (other.rows > 0) posterior = combine_posteriors(view(posterior), other);
    return box_contrast(view(posterior), box, search.around);
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
    return (peak - mean) / std::max(std::sqrt(std::max(power - mean * mean, 0.0)), kLeastDeviation);
}

Span find_span(double center, double length, int size) {
    const double last = size - 1.0, most = size;
    const double first = std::min(std::max(std::nearbyint(center - length / 2), 0.0), last);
    return {static_cast<int>(first),
            static_cast<int>(std::max(std::min(std::nearbyint(center + length / 2), most), first + 1))};
}

/// The pixels of a part of a patch, channel by channel.
std::vector<std::uint8_t> take_colors(const ImageView& patch, Span rows, Span columns) {
    const std::size_t n = static_cast<std::size_t>(rows.size()) * static_cast<std::size_t>(columns.size());
    std::vector<std::uint8_t> colors(3 * n);
    std::uint8_t *blue = colors.data(), *green = blue + n, *red = green + n;
    for (int y = rows.first; y < rows.end; ++y) {
        const std::uint8_t* pixel = patch.row(y) + 3 * std::ptrdiff_t{columns.first};
        for (int x = 0; x < columns.size(); ++x, pixel += 3) {
            *blue++ = pixel[0];
            *green++ = pixel[1];
            *red++ = pixel[2];
        }
    }
    return colors;
}

int bins_of(VectorRef roots) {
    for (int bins = 1; bins <= 64; bins *= 2)
        if (roots.size() == Eigen::Index{bins} * bins * bins) return bins;
    refuse("roots", "(B³,), B a power of two up to 64", std::to_string(roots.size()));
}

double color_similarity(const ImageView& patch, VectorRef roots, int bins, double right, double down,
                        const TargetSearch& search) {
    const Span rows = find_span(patch.rows / 2.0 + down, search.inner * search.height, patch.rows),
               columns = find_span(patch.cols / 2.0 + right, search.inner * search.width, patch.cols);
    const std::vector<std::uint8_t> colors = take_colors(patch, rows, columns);
    const Floats histogram =
        joint_histogram({colors.data(), 1, std::ptrdiff_t{rows.size()} * columns.size()}, bins);
    double sum = 0.0;
    for (Eigen::Index i = 0; i < histogram.size(); ++i)
        if (histogram.data()[i] > 0.0F) sum += std::sqrt(double{histogram.data()[i]}) * roots[i];
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

LocalizedTarget localize_target(const ImageView& patch, FloatsRef taper, const TargetLook& look,
                                const PlaneView& other, const TargetSearch& search) {
    require_arguments(patch, other, search);
    const int bins = bins_of(look.roots);
    const Floats cells = hog_color_cells(patch, taper);
    const int rows = static_cast<int>(taper.rows()), cols = static_cast<int>(taper.cols()),
              filters = look.filters.filters;
    Floats responses =
        correlation_response({cells.data(), static_cast<int>(cells.rows()) / rows, rows, cols}, look.filters);
    const Vector peak = evidence_peak({responses.data(), filters, rows, cols},
                                      find_contrast(patch, look.table, other, search),
                                      {search.filter_weight, search.contrast_weight});
    Vector found(peak.size() + 2);
    found.head(peak.size()) = peak;
    found[peak.size()] = peak_sharpness(responses.data(), taper.size(), peak[5]);
    found[peak.size() + 1] = color_similarity(patch, look.roots, bins, 2 * peak[0], 2 * peak[1], search);
    return {std::move(found), std::move(responses)};
}

}  // namespace tricue
