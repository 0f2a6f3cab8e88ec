// SPDX-License-Identifier: MIT
#include "cues/stereo/ellipse_disparity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/ellipse_shape.hpp"
#include "base/simd.hpp"
#include "cues/stereo/detail/cell_disparities.hpp"

namespace tricue {
namespace {

struct Values {
    const float* data;
    std::size_t count;

    const float* begin() const { return data; }
    const float* end() const { return data + count; }
};

/// Moves the pixels' disparities that aren't NaN to the front of `found`; returns their number.
TRICUE_MULTIVERSION
std::size_t pick_matched(float* found, std::size_t n, bool subpixel) {
    std::size_t matched = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const float value = found[i];
        found[matched] = subpixel ? value : std::ceil(value - 0.5F) + 0.0F;  // not -0
        matched += value == value;
    }
    return matched;
}

/// The median of at least one number, all between `low` and `high`. Only those near the middle are sorted: disparities cluster
/// around one value.
double take_median(const Values& values, float low, float high) {
    constexpr std::size_t kBuckets = 512;
    const float scale = static_cast<float>(kBuckets - 1) / (high - low);
    const auto bucket_of = [=](float value) { return static_cast<std::size_t>((value - low) * scale); };
    std::array<std::uint32_t, kBuckets> counts{};
    for (const float value : values) ++counts[bucket_of(value)];

    const std::size_t upper = values.count / 2, lower = (values.count - 1) / 2;  // indices of the middle two
    std::size_t first = 0, before = 0;
    while (before + counts[first] <= lower) before += counts[first++];
    std::size_t last = first, until = before + counts[first];
    while (until <= upper) until += counts[++last];
    std::vector<float> middle;
    middle.reserve(until - before);
    for (const float value : values)
        if (const std::size_t bucket = bucket_of(value); bucket >= first && bucket <= last)
            middle.push_back(value);
    const auto at = middle.begin() + static_cast<std::ptrdiff_t>(upper - before);
    std::nth_element(middle.begin(), at, middle.end());
    if (lower == upper) return *at;
    return static_cast<double>(*std::max_element(middle.begin(), at) + *at) / 2.0;
}

double take_mean(const Values& values) {
    double sum = 0.0;
    for (const float value : values) sum += value;
    return static_cast<float>(sum) / static_cast<float>(values.count);
}

TRICUE_MULTIVERSION
int count_near(const float* values, std::size_t n, float disparity, float tolerance) {
    int near = 0;
    for (std::size_t i = 0; i < n; ++i) near += std::abs(values[i] - disparity) <= tolerance;
    return near;
}

}  // namespace

EllipseDisparity ellipse_disparity(const ImageView& left, const ImageView& right, VectorRef ellipse,
                                   const DisparityRange& limits, const StereoMatching& matching,
                                   const DisparityStatistic& statistic) {
    if (!(statistic.tolerance >= 0.0F)) refuse("tolerance", "0 or more", statistic.tolerance);
    require_ellipse(ellipse);
    const EllipseShape shape(ellipse.data(), 1.0);
    constexpr EllipseDisparity kNothing{std::numeric_limits<double>::quiet_NaN(), 0, 0};
    if (shape.area == 0) return kNothing;
    Floats found = cell_disparities({left, right, 1}, shape, CenterPixel(ellipse.data()), limits, matching);
    const std::size_t count =
        pick_matched(found.data(), static_cast<std::size_t>(found.size()), statistic.subpixel);
    if (count == 0) return kNothing;
    const Values matched{found.data(), count};
    const double disparity = statistic.median ? take_median(matched, static_cast<float>(limits.first) - 1.0F,
                                                            static_cast<float>(limits.last) + 1.0F)
                                              : take_mean(matched);
    return {disparity, static_cast<int>(count),
            count_near(matched.data, count, static_cast<float>(disparity), statistic.tolerance)};
}

}  // namespace tricue
