// SPDX-License-Identifier: MIT
#include "cues/color/detail/compact_bins.hpp"

#include <algorithm>

#include "base/simd.hpp"

namespace tricue {
namespace {

static_assert((CompactBins::kUnmatchedCount & (CompactBins::kUnmatchedCount - 1)) == 0);

/// Marks a bin of the model that hasn't occurred yet. kOutside is free for this: no bin has it, even if all 65535 have an index.
constexpr std::uint16_t kUnassigned = CompactBins::kOutside;

/// Returns the number of bins that are empty in the model.
TRICUE_MULTIVERSION
int initialize_indices(const double* __restrict model, std::size_t size, std::uint16_t* __restrict indices) {
    int empty = 0;
    for (std::size_t bin = 0; bin < size; ++bin) {
        indices[bin] = model[bin] > 0.0 ? kUnassigned : CompactBins::kUnmatched;
        empty += !(model[bin] > 0.0);
    }
    return empty;
}

TRICUE_MULTIVERSION
void mark(const std::uint8_t* __restrict mask, const std::uint16_t* __restrict bins, int n,
          std::uint8_t* __restrict marks) {
    for (int x = 0; x < n; ++x) marks[x] = (mask[x] != 0) & (bins[x] != kNoBin);
}

}  // namespace

CompactBins::CompactBins(const BinsView& bins, VectorRef model, double total, const ImageView& mask,
                         const Region& area)
    : cols(area.x1 - area.x0),
      indices(static_cast<std::size_t>(cols) * static_cast<std::size_t>(area.y1 - area.y0), kOutside),
      masked(mask.data == nullptr ? 0 : indices.size() + kMaskPadding) {
    const Region visible = area.clipped({nullptr, bins.rows, bins.cols, 1, 0});
    fill_indices(bins, model, total, area, visible);
    if (mask.data != nullptr) fill_masked(bins, mask, area, visible);
}

void CompactBins::fill_indices(const BinsView& bins, VectorRef model, double total, const Region& area,
                               const Region& visible) {
    const auto size = static_cast<std::uint16_t>(model.size());
    std::vector<std::uint16_t> table(std::size_t{size} + 1,
                                     kOutside);  // the last is for pixels without a bin
    const int empty = initialize_indices(model.data(), size, table.data());
    // Never more indices than empty bins: with those of the other bins they fit 16 bits.
    const int unmatched = empty < kUnmatchedCount ? std::min(empty, 1) : kUnmatchedCount;
    const int spread_mask = std::max(unmatched - 1, 0);
    shares.assign(std::size_t{kUnmatched} + static_cast<std::size_t>(unmatched), 0.0);
    for (int y = visible.y0; y < visible.y1; ++y) {
        const std::uint16_t* row = bins.row(y);
        std::uint16_t* out = indices.data() + std::ptrdiff_t{y - area.y0} * cols - area.x0;
        for (int x = visible.x0; x < visible.x1; ++x) {
            const std::uint16_t bin = std::min(row[x], size);
            if (table[bin] == kUnassigned && bin != size) {
                table[bin] = static_cast<std::uint16_t>(shares.size());
                shares.push_back(model[bin] / total);
            }
            const int spread = table[bin] == kUnmatched ? (x + y) & spread_mask : 0;
            out[x] = static_cast<std::uint16_t>(table[bin] + spread);
        }
    }
    shares.resize((shares.size() + kPadding - 1) / kPadding * kPadding, 0.0);
}

void CompactBins::fill_masked(const BinsView& bins, const ImageView& mask, const Region& area,
                              const Region& visible) {
    for (int y = visible.y0; y < visible.y1; ++y) {
        std::uint8_t* out = masked.data() + std::ptrdiff_t{y - area.y0} * cols - area.x0;
        mark(mask.row(y) + visible.x0, bins.row(y) + visible.x0, visible.x1 - visible.x0, out + visible.x0);
    }
}

}  // namespace tricue
