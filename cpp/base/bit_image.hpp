// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/simd.hpp"

namespace tricue {

/// A mask with one bit per pixel: bit x % 64 of word x / 64 of its row. It is surrounded by zeros.
class BitImage {
public:
    static constexpr int kWord = 64;  ///< pixels

    BitImage(int rows, int cols)
        : cols_(cols),
          words_((cols + kWord - 1) / kWord),
          stride_(static_cast<std::size_t>(words_) + 2),
          bits_((static_cast<std::size_t>(rows) + 2) * stride_) {}

    int words() const { return words_; }  ///< of a row
    std::uint64_t& word(int y, int i) { return row(y)[i]; }
    TRICUE_INLINE std::uint64_t word(int y, int i) const { return row(y)[i]; }

    bool is_empty(int y) const {
        const std::uint64_t* first = row(y);
        return std::all_of(first, first + words_, [](std::uint64_t each) { return each == 0; });
    }

    void set(int y, int x) { word(y, x / kWord) |= std::uint64_t{1} << (x % kWord); }

    /// Sets the bits of the row's bytes that aren't 0.
    void read(int y, const std::uint8_t* bytes) {
        int i = 0;
        for (; (i + 1) * kWord <= cols_; ++i) word(y, i) = nonzero_bytes(bytes + i * kWord);
        if (i == words_) return;
        std::array<std::uint8_t, kWord> last{};
        std::copy(bytes + i * kWord, bytes + cols_, last.data());
        word(y, i) = nonzero_bytes(last.data());
    }

    /// The set pixels of a word with a set pixel among their 8 neighbors.
    TRICUE_INLINE std::uint64_t joined(int y, int i) const {
        const std::uint64_t *above = row(y - 1) + i, *here = row(y) + i, *below = row(y + 1) + i;
        return *here & (beside(here) | *above | beside(above) | *below | beside(below));
    }

    /// The 8 neighbors of a word's pixels: bit x of each result is one of pixel x.
    TRICUE_INLINE std::array<std::uint64_t, 8> neighbors(int y, int i) const {
        const std::uint64_t *above = row(y - 1) + i, *here = row(y) + i, *below = row(y + 1) + i;
        return {left(above), *above,      right(above), left(here),
                right(here), left(below), *below,       right(below)};
    }

private:
    TRICUE_INLINE const std::uint64_t* row(int y) const {
        return bits_.data() + static_cast<std::size_t>(y + 1) * stride_ + 1;
    }
    std::uint64_t* row(int y) { return bits_.data() + static_cast<std::size_t>(y + 1) * stride_ + 1; }

    /// Pixels with a set one to their left, to their right, and on either side.
    TRICUE_INLINE static std::uint64_t left(const std::uint64_t* word) {
        return word[0] << 1 | word[-1] >> 63;
    }
    TRICUE_INLINE static std::uint64_t right(const std::uint64_t* word) {
        return word[0] >> 1 | word[1] << 63;
    }
    TRICUE_INLINE static std::uint64_t beside(const std::uint64_t* word) { return left(word) | right(word); }

    int cols_, words_;
    std::size_t stride_;
    std::vector<std::uint64_t> bits_;
};

/// Writes first + i for each bit i that is set, ascending, and returns the end of these numbers; up to kAtOnce more are
/// overwritten. Branches on the next bit would be mispredicted, so kAtOnce are always written.
template <int kAtOnce, typename Number>
TRICUE_INLINE Number* list_bits(std::uint64_t bits, Number first, Number* to) {
    constexpr std::uint64_t kAll = ~std::uint64_t{0}, kHighest = std::uint64_t{1} << 63;
    if (bits == kAll) {
        for (int i = 0; i < BitImage::kWord; ++i) to[i] = first + i;
        return to + BitImage::kWord;
    }
    Number* const end = to + count_bits(bits);
    while (true) {
        for (int i = 0; i < kAtOnce; ++i, bits &= bits - 1) to[i] = first + lowest_bit(bits | kHighest);
        if (bits == 0) return end;
        to += kAtOnce;
    }
}

}  // namespace tricue
