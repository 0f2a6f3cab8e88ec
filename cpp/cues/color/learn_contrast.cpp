// SPDX-License-Identifier: MIT
#include "cues/color/learn_contrast.hpp"

#include <string>

#include "base/check.hpp"
#include "cues/color/detail/learn_histograms.hpp"
#include "cues/color/joint_histogram.hpp"

namespace tricue {
namespace {

void require_one(const SampleView& samples, const char* name) {
    if (samples.ellipses != 1) refuse(name, "the samples of one ellipse", std::to_string(samples.ellipses));
}

/// The samples' histogram, as a cube.
Floats seen_histogram(const SampleView& samples, FloatsRef old) {
    Floats seen = joint_histogram(samples, static_cast<int>(old.cols()));
    seen.resize(old.rows(), old.cols());
    return seen;
}

}  // namespace

ColorContrast learn_contrast(const SampleView& inside, const SampleView& around, FloatsRef target,
                             FloatsRef surround, double rate, double rare) {
    require_one(inside, "inside");
    require_one(around, "around");
    require_histograms(target, surround, rate, rare);
    return learn_histograms(seen_histogram(inside, target), seen_histogram(around, surround), target,
                            surround, rate, rare);
}

}  // namespace tricue
