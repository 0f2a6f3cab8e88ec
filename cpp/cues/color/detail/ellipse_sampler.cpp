// SPDX-License-Identifier: MIT
#include "cues/color/detail/ellipse_sampler.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::ptrdiff_t kWordBytes = sizeof(std::uint32_t);
constexpr std::ptrdiff_t kTogether = 8;  // words that are read in one step of the loop

/// The places of one ellipse as byte offsets into the image. Clamping comes first, so truncation is the floor. An ellipse
/// that float32 can't hold has infinite places, or NaN, which max() turns to 0 only as its second argument.
TRICUE_MULTIVERSION
void find_offsets(const float* __restrict u, const float* __restrict v, std::ptrdiff_t n,
                  const double* ellipse, int cols, int rows, std::int32_t stride,
                  std::int32_t* __restrict offsets) {
    const auto x = static_cast<float>(ellipse[0]), y = static_cast<float>(ellipse[1]);
    const auto minor = static_cast<float>(ellipse[2]), major = static_cast<float>(ellipse[3]);
    const auto right = static_cast<float>(cols - 1), bottom = static_cast<float>(rows - 1);
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const float column = std::min(std::max(0.0f, x + minor * u[k]), right);
        const float row = std::min(std::max(0.0f, y + major * v[k]), bottom);
        offsets[k] = static_cast<std::int32_t>(row) * stride + static_cast<std::int32_t>(column) * 3;
    }
}

TRICUE_MULTIVERSION
void find_furthest(const std::int32_t* offsets, std::ptrdiff_t n, std::int32_t* furthest) {
    std::int32_t most = 0;
    for (std::ptrdiff_t k = 0; k < n; ++k) most = std::max(most, offsets[k]);
    *furthest = most;
}

/// Reads each pixel as a word of four bytes, the fourth from the next pixel. The image's last pixel has no next one, so it is
/// read one byte early and shifted. Not multiversioned: gathers are slower than loads on processors with the Downfall mitigation.
void gather(const std::uint8_t* pixels, std::int32_t last, const std::int32_t* offsets, std::ptrdiff_t n,
            std::uint32_t* words) {
    std::int32_t furthest = 0;
    find_furthest(offsets, n, &furthest);
    if (furthest <= last) {
        std::ptrdiff_t k = 0;
        for (; k + kTogether <= n; k += kTogether)
            for (std::ptrdiff_t i = k; i < k + kTogether; ++i)
                std::memcpy(words + i, pixels + offsets[i], sizeof *words);
        for (; k < n; ++k) std::memcpy(words + k, pixels + offsets[k], sizeof *words);
        return;
    }
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        std::memcpy(words + k, pixels + std::min(offsets[k], last), sizeof *words);
        if (offsets[k] > last) words[k] >>= 8 * (offsets[k] - last);
    }
}

TRICUE_MULTIVERSION
void split_channels(const std::uint32_t* __restrict words, std::ptrdiff_t n, std::uint8_t* __restrict blue,
                    std::uint8_t* __restrict green, std::uint8_t* __restrict red) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t k) {
        blue[k] = static_cast<std::uint8_t>(words[k]);
        green[k] = static_cast<std::uint8_t>(words[k] >> 8);
        red[k] = static_cast<std::uint8_t>(words[k] >> 16);
    });
}

/// Bytes from the first of an image to its last. The rows of a broadcast image are a single row in memory.
std::ptrdiff_t count_bytes(const ImageView& image) {
    return (image.rows - 1) * image.stride + 3 * std::ptrdiff_t{image.cols};
}

}  // namespace

EllipseSampler::EllipseSampler(const ImageView& image, StatesRef pattern, const char* name) : image_(image) {
    require_shape(pattern, pattern.rows(), 2, name);
    if (image.rows < 1 || image.cols < 1) refuse("image", "at least one pixel", "none");
    require_finite(pattern, name);

    u_ = pattern.col(0).cast<float>();
    v_ = pattern.col(1).cast<float>();
    offsets_.resize(kBatch * pattern.rows());
    words_.resize(kBatch * pattern.rows());
    const std::ptrdiff_t bytes = count_bytes(image);
    if (bytes > std::numeric_limits<std::int32_t>::max())
        refuse("image", "at most 2 GB from its first to its last pixel", bytes);
    last_word_ = static_cast<std::int32_t>(std::max<std::ptrdiff_t>(bytes - kWordBytes, 0));
    if (bytes < kWordBytes) std::memcpy(single_pixel_, image.data, 3);
}

void EllipseSampler::read(const double* ellipses, std::ptrdiff_t count, std::uint8_t* planes) {
    for (; count > 0; count -= kBatch, ellipses += 4 * kBatch, planes += 3 * size() * kBatch) {
        const std::ptrdiff_t batch = std::min(count, kBatch);
        split(read_words(ellipses, batch), batch, planes);
    }
}

/// Each step is done for the whole batch before the next one, because wide loads must wait for earlier narrow stores.
const std::uint32_t* EllipseSampler::read_words(const double* ellipses, std::ptrdiff_t count) {
    const std::ptrdiff_t n = size();
    const bool single = count_bytes(image_) < kWordBytes;
    for (std::ptrdiff_t i = 0; i < count; ++i)
        find_offsets(u_.data(), v_.data(), n, ellipses + 4 * i, image_.cols, image_.rows,
                     static_cast<std::int32_t>(image_.stride), offsets_.data() + n * i);
    gather(single ? single_pixel_ : image_.data, last_word_, offsets_.data(), n * count, words_.data());
    return words_.data();
}

void EllipseSampler::split(const std::uint32_t* words, std::ptrdiff_t count, std::uint8_t* planes) const {
    const std::ptrdiff_t n = size();
    for (std::ptrdiff_t i = 0; i < count; ++i, words += n, planes += 3 * n)
        split_channels(words, n, planes, planes + n, planes + 2 * n);
}

}  // namespace tricue
