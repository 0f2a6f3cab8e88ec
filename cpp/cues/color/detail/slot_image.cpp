// SPDX-License-Identifier: MIT
#include "cues/color/detail/slot_image.hpp"

#include <algorithm>

#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::uint16_t kNew = kNoBin;  ///< a bin that the model has and that hasn't occurred yet

TRICUE_MULTIVERSION
void first_slots(const double* __restrict model, std::size_t size, std::uint16_t* __restrict slots) {
    for (std::size_t bin = 0; bin < size; ++bin) slots[bin] = model[bin] > 0.0 ? kNew : SlotImage::kUnmatched;
}

}  // namespace

SlotImage::SlotImage(const BinsView& bins, VectorRef model, double total, const ImageView& mask,
                     const Region& area)
    : cols(area.x1 - area.x0),
      slots(static_cast<std::size_t>(cols) * static_cast<std::size_t>(area.y1 - area.y0), kOutside),
      marks(mask.data == nullptr ? 0 : slots.size()),
      shares(kUnmatched + kSpread, 0.0) {
    const Region seen = area.clipped({nullptr, bins.rows, bins.cols, 1, 0});
    fill(bins, model, total, area, seen);
    if (mask.data != nullptr) mark(bins, mask, area, seen);
}

void SlotImage::fill(const BinsView& bins, VectorRef model, double total, const Region& area,
                     const Region& seen) {
    const auto size = static_cast<std::uint16_t>(model.size());
    std::vector<std::uint16_t> table(std::size_t{size} + 1, kOutside);  // the last for no bin
    first_slots(model.data(), size, table.data());
    for (int y = seen.y0; y < seen.y1; ++y) {
        const std::uint16_t* row = bins.row(y);
        std::uint16_t* out = slots.data() + std::ptrdiff_t{y - area.y0} * cols - area.x0;
        for (int x = seen.x0; x < seen.x1; ++x) {
            const std::uint16_t bin = std::min(row[x], size);
            if (table[bin] == kNew) {
                table[bin] = static_cast<std::uint16_t>(shares.size());
                shares.push_back(model[bin] / total);
            }
            const int spread = table[bin] == kUnmatched ? (x + y) % kSpread : 0;
            out[x] = static_cast<std::uint16_t>(table[bin] + spread);
        }
    }
    shares.resize((shares.size() + kPadding - 1) / kPadding * kPadding, 0.0);
}

void SlotImage::mark(const BinsView& bins, const ImageView& mask, const Region& area, const Region& seen) {
    for (int y = seen.y0; y < seen.y1; ++y) {
        std::uint8_t* out = marks.data() + std::ptrdiff_t{y - area.y0} * cols - area.x0;
        for (int x = seen.x0; x < seen.x1; ++x) out[x] = (mask.row(y)[x] != 0) & (bins.row(y)[x] != kNoBin);
    }
}

}  // namespace tricue
