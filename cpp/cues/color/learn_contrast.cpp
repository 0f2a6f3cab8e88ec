// SPDX-License-Identifier: MIT
#include "cues/color/learn_contrast.hpp"

#include <cstdint>
#include <vector>

#include "base/check.hpp"
#include "base/color_cells.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/ellipse_sampler.hpp"
#include "cues/color/detail/learn_histograms.hpp"

namespace tricue {
namespace {

/// The shares for counts from 0 to all samples, so that a histogram needs no division per cell.
TRICUE_MULTIVERSION
void divide(std::ptrdiff_t samples, float* shares) {
    const auto all = static_cast<float>(samples);
    for (std::int32_t count = 0; count <= samples; ++count) shares[count] = static_cast<float>(count) / all;
}

/// The samples' histogram, as a cube. Most cells stay empty: only those of the samples are touched, some more than once.
Floats seen_histogram(EllipseSampler& sampler, const double* ellipse, FloatsRef old) {
    const auto n = static_cast<std::size_t>(sampler.size());
    std::vector<std::int32_t> cells(n), counts(static_cast<std::size_t>(old.size()));
    word_cells(sampler.read_words(ellipse, 1), sampler.size(), bits_of_cube(old, "target"), cells.data());
    for (const std::int32_t cell : cells) ++counts[static_cast<std::size_t>(cell)];
    std::vector<float> shares(n + 1);
    divide(sampler.size(), shares.data());
    Floats seen = Floats::Zero(old.rows(), old.cols());
    for (const std::int32_t cell : cells)
        seen.data()[cell] = shares[static_cast<std::size_t>(counts[static_cast<std::size_t>(cell)])];
    return seen;
}

constexpr double kUnseen = 0.0;  // P(target) of a color that neither target nor surround has

}  // namespace

ColorContrast learn_contrast(const ImageView& image, VectorRef ellipse, const EllipsePattern& pattern,
                             FloatsRef target, FloatsRef surround, double rate, double rare) {
    require_size(ellipse, 4, "ellipse");
    require_finite(ellipse, "ellipse");
    EllipseSampler inside(image, pattern.inside, "inside"), around(image, pattern.around, "around");
    require_histograms(target, surround, rate, rare);
    return learn_histograms(seen_histogram(inside, ellipse.data(), target),
                            seen_histogram(around, ellipse.data(), surround), target, surround, rate, rare,
                            kUnseen);
}

}  // namespace tricue
