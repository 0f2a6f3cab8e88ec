// SPDX-License-Identifier: MIT
#include "cues/color/color_bins.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::int64_t kMaxSide = 32768;
constexpr double kMaxGain =
    255.0;  // larger gains have the same effect, but may be infinite in float32, and 0 times infinity is NaN

/// An axis as factors: floor(v bins / levels) is the integer part of (v bins + 1/2) (1 / levels). That is at least 1 / (2 levels) away
/// from an integer, a hundred times the rounding error of float32.
struct Axis {
    float bins, inverse;

    Axis(const ColorSpace& space, std::size_t axis)
        : bins(static_cast<float>(space.bins[axis])),
          inverse(1.0F / static_cast<float>(space.levels(axis))) {}
};

TRICUE_INLINE int find_bin(int level, const Axis& axis) {
    return static_cast<int>((static_cast<float>(level) * axis.bins + 0.5F) * axis.inverse);
}

/// Gains of blue, green and red.
using Light = std::array<float, 3>;

/// A level in another light, rounded half to even as by OpenCV: above 2^23, floats are whole numbers.
TRICUE_INLINE int relight(int level, float gain) {
    constexpr float kWhole = 8388608.0F;
    return static_cast<int>((std::min(static_cast<float>(level) * gain, 255.0F) + kWhole) - kWhole);
}

TRICUE_MULTIVERSION
void bin_row(const std::uint8_t* __restrict pixels, std::ptrdiff_t n, const ColorSpace& space,
             std::uint16_t* __restrict bins, const Light& light) {
    const Axis first(space, 0), second(space, 1), third(space, 2);
    const int chroma = space.chroma, last = 2 * space.chroma - 1;
    const int stride0 = space.bins[1] * space.bins[2], stride1 = space.bins[2];
    const float blue = light[0], green = light[1], red = light[2];
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
        const int b = relight(pixels[3 * x], blue), g = relight(pixels[3 * x + 1], green),
                  r = relight(pixels[3 * x + 2], red);
        const int i = find_bin(std::min(std::max(b - g + chroma, 0), last), first);
        const int j = find_bin(std::min(std::max(g - r + chroma, 0), last), second);
        bins[x] = static_cast<std::uint16_t>(i * stride0 + j * stride1 + find_bin(b + g + r, third));
    });
}

/// The rows or columns of bins whose pixels lie in the image: those of [begin, begin + step count) inside [0, size).
struct Span {
    Eigen::Index begin, end;

    Span(std::int64_t start, Eigen::Index count, int step, int size) {
        const auto before = [&](std::int64_t limit) {
            return std::clamp<std::int64_t>((limit - start - step / 2 + step - 1) / step, 0, count);
        };
        begin = start + step / 2 < 0 ? before(0) : 0;
        end = std::max(start + step / 2 < size ? before(size) : 0, begin);
    }
};

Light light_of(const std::array<double, 3>& gains) {
    Light light{};
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(gains[c] >= 0.0 && std::isfinite(gains[c])))
            refuse("gains", "finite numbers, none negative", gains[c]);
        light[c] = static_cast<float>(std::min(gains[c], kMaxGain));
    }
    return light;
}

/// Copies every step-th pixel.
void subsample(const std::uint8_t* pixels, Eigen::Index n, int step, std::uint8_t* packed) {
    for (Eigen::Index k = 0; k < n; ++k, pixels += 3 * step, packed += 3)
        for (std::size_t c = 0; c < 3; ++c) packed[c] = pixels[c];
}

std::int64_t require_side(std::int64_t begin, std::int64_t end) {
    if (end - begin > kMaxSide)
        refuse("region", "sides of at most 32768 pixels", std::to_string(end - begin));
    return std::max<std::int64_t>(end - begin, 0);
}

}  // namespace

Bins color_bins(const ImageView& image, const Region& region, const ColorSpace& space, int step,
                const std::array<double, 3>* gains) {
    require_space(space);
    if (step < 1 || step > 1024) refuse("step", "1 to 1024", step);
    const auto width = require_side(region.x0, region.x1), height = require_side(region.y0, region.y1);

    const Light light = gains ? light_of(*gains) : Light{1.0F, 1.0F, 1.0F};
    const bool copied = step > 1;

    Bins bins((height + step - 1) / step, (width + step - 1) / step);
    const Span rows(region.y0, bins.rows(), step, image.rows), cols(region.x0, bins.cols(), step, image.cols);
    const auto inside = cols.end - cols.begin;
    std::vector<std::uint8_t> packed(copied ? static_cast<std::size_t>(3 * inside) : 0);
    for (Eigen::Index i = 0; i < bins.rows(); ++i) {
        std::uint16_t* out = bins.data() + i * bins.cols();
        if (i < rows.begin || i >= rows.end || inside == 0) {
            std::fill_n(out, bins.cols(), kNoBin);
            continue;
        }
        const auto y = region.y0 + step * i + step / 2, x = region.x0 + step * cols.begin + step / 2;
        const std::uint8_t* pixels = image.row(static_cast<int>(y)) + 3 * x;
        if (copied) subsample(pixels, inside, step, packed.data());
        std::fill_n(out, cols.begin, kNoBin);
        bin_row(copied ? packed.data() : pixels, inside, space, out + cols.begin, light);
        std::fill(out + cols.end, out + bins.cols(), kNoBin);
    }
    return bins;
}

}  // namespace tricue
