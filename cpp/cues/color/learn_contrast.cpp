// SPDX-License-Identifier: MIT
#include "cues/color/learn_contrast.hpp"

#include <vector>

#include "base/check.hpp"
#include "cues/color/detail/color_cells.hpp"
#include "cues/color/detail/ellipse_sampler.hpp"
#include "cues/color/detail/learn_histograms.hpp"

namespace tricue {
namespace {

/// The samples' histogram, as a cube.
Floats seen_histogram(EllipseSampler& sampler, const double* ellipse, FloatsRef old) {
    const int bits = bits_of_cube(old, "target");
    std::vector<std::int32_t> cells(static_cast<std::size_t>(sampler.size()));
    word_cells(sampler.read_words(ellipse, 1), sampler.size(), bits, cells.data());
    ColorCounts counts(bits);
    counts.add(cells);
    return counts.shares(old.rows());
}

}  // namespace

ColorContrast learn_contrast(const ImageView& image, VectorRef ellipse, const Windows& windows,
                             FloatsRef target, FloatsRef surround, double rate, double rare) {
    require_size(ellipse, 4, "ellipse");
    require_finite(ellipse, "ellipse");
    EllipseSampler inside(image, windows.inside, "inside"), around(image, windows.around, "around");
    require_histograms(target, surround, rate, rare);
    return learn_histograms(seen_histogram(inside, ellipse.data(), target),
                            seen_histogram(around, ellipse.data(), surround), target, surround, rate, rare);
}

}  // namespace tricue
