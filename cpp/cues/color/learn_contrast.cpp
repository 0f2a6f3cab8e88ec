// SPDX-License-Identifier: MIT
#include "cues/color/learn_contrast.hpp"

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/color_cells.hpp"
#include "cues/color/joint_histogram.hpp"

namespace tricue {
namespace {

void require_one(const SampleView& samples, const char* name) {
    if (samples.ellipses != 1) refuse(name, "the samples of one ellipse", std::to_string(samples.ellipses));
}

TRICUE_MULTIVERSION
void blend(const float* __restrict old, float rate, std::ptrdiff_t n, float* __restrict blended) {
    for (std::ptrdiff_t k = 0; k < n; ++k) blended[k] = old[k] + rate * (blended[k] - old[k]);
}

TRICUE_MULTIVERSION
void compute_table(const float* __restrict target, const float* __restrict surround, float rare,
                   std::ptrdiff_t n, float* __restrict table) {
    for (std::ptrdiff_t k = 0; k < n; ++k) table[k] = target[k] / (target[k] + surround[k] + rare);
}

/// The samples' histogram, as a cube, blended into the old one.
Floats updated_histogram(const SampleView& samples, FloatsRef old, double rate) {
    Floats seen = joint_histogram(samples, static_cast<int>(old.cols()));
    seen.resize(old.rows(), old.cols());
    blend(old.data(), static_cast<float>(rate), seen.size(), seen.data());
    return seen;
}

}  // namespace

ColorContrast learn_contrast(const SampleView& inside, const SampleView& around, FloatsRef target,
                             FloatsRef surround, double rate, double rare) {
    require_one(inside, "inside");
    require_one(around, "around");
    if (bits_of_cube(target, "target") != bits_of_cube(surround, "surround"))
        refuse("surround", "the target's shape", "B = " + std::to_string(surround.cols()));
    if (!(rate >= 0.0 && rate <= 1.0)) refuse("rate", "a number in [0, 1]", rate);
    if (!(rare > 0.0)) refuse("rare", "a number above 0", rare);

    Floats within = updated_histogram(inside, target, rate),
           without = updated_histogram(around, surround, rate);
    Floats table(within.rows(), within.cols());
    compute_table(within.data(), without.data(), static_cast<float>(rare), table.size(), table.data());
    return {std::move(within), std::move(without), std::move(table)};
}

}  // namespace tricue
