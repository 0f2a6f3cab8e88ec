// SPDX-License-Identifier: MIT
#include "cues/color/learn_contrast.hpp"

#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/color_cells.hpp"

namespace tricue {
namespace {

void require_one(const SampleView& samples, const char* name) {
    if (samples.ellipses != 1) refuse(name, "the samples of one ellipse", std::to_string(samples.ellipses));
}

/// The histogram in which no color of this frame is: old + rate (0 - old).
TRICUE_MULTIVERSION
void fade(const float* __restrict old, float rate, std::ptrdiff_t n, float* __restrict faded) {
    for (std::ptrdiff_t k = 0; k < n; ++k) faded[k] = old[k] + rate * (0.0f - old[k]);
}

TRICUE_MULTIVERSION
void compute_table(const float* __restrict target, const float* __restrict surround, float rare,
                   std::ptrdiff_t n, float* __restrict table) {
    for (std::ptrdiff_t k = 0; k < n; ++k) table[k] = target[k] / (target[k] + surround[k] + rare);
}

/// Histograms of one ellipse's samples, as joint_histogram has them, blended into old ones. Most cells stay empty: only those of
/// the samples are counted.
class Blender {
public:
    Blender(int bits, float rate) : bits_(bits), rate_(rate), counts_(std::size_t{1} << (3 * bits)) {}

    Floats operator()(const SampleView& samples, FloatsRef old) {
        Floats blended(old.rows(), old.cols());
        fade(old.data(), rate_, old.size(), blended.data());
        cells_.resize(static_cast<std::size_t>(samples.n));
        color_cells(samples, 0, bits_, cells_.data());
        for (const std::int32_t cell : cells_) ++counts_[static_cast<std::size_t>(cell)];
        const auto n = static_cast<float>(samples.n);
        for (const std::int32_t cell : cells_) {
            std::int32_t& count = counts_[static_cast<std::size_t>(cell)];
            if (count == 0) continue;  // done already
            const float before = old.data()[cell], seen = static_cast<float>(count) / n;
            blended.data()[cell] = before + rate_ * (seen - before);
            count = 0;
        }
        return blended;
    }

private:
    int bits_;
    float rate_;
    std::vector<std::int32_t> cells_, counts_;
};

}  // namespace

ColorContrast learn_contrast(const SampleView& inside, const SampleView& around, FloatsRef target,
                             FloatsRef surround, double rate, double rare) {
    require_one(inside, "inside");
    require_one(around, "around");
    const int bits = bits_of_cube(target, "target");
    if (bits != bits_of_cube(surround, "surround"))
        refuse("surround", "the target's shape", "B = " + std::to_string(surround.cols()));
    if (!(rate >= 0.0 && rate <= 1.0)) refuse("rate", "a number in [0, 1]", rate);
    if (!(rare > 0.0)) refuse("rare", "a number above 0", rare);

    Blender blend(bits, static_cast<float>(rate));
    Floats within = blend(inside, target), without = blend(around, surround);
    Floats table(within.rows(), within.cols());
    compute_table(within.data(), without.data(), static_cast<float>(rare), table.size(), table.data());
    return {std::move(within), std::move(without), std::move(table)};
}

}  // namespace tricue
