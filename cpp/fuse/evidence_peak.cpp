// SPDX-License-Identifier: MIT
#include "fuse/evidence_peak.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "fuse/detail/parabola.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void weigh(const float* __restrict response, float weight, std::ptrdiff_t n, float* __restrict evidence) {
    for (std::ptrdiff_t i = 0; i < n; ++i) evidence[i] = weight * response[i];
}

TRICUE_MULTIVERSION
void add_weighted(const float* __restrict contrast, float weight, std::ptrdiff_t n,
                  float* __restrict evidence) {
    for (std::ptrdiff_t i = 0; i < n; ++i) evidence[i] += weight * contrast[i];
}

/// The maximum of each column; 0 times a number that isn't finite makes that column's `strange` NaN.
TRICUE_MULTIVERSION
void compare_row(const float* __restrict row, int cols, float* __restrict greatest,
                 float* __restrict strange) {
    for (int x = 0; x < cols; ++x) {
        greatest[x] = row[x] > greatest[x] ? row[x] : greatest[x];
        strange[x] += 0.0F * row[x];
    }
}

/// The first of equal maxima.
Eigen::Index find_greatest(const Floats& evidence) {
    const auto cols = static_cast<std::size_t>(evidence.cols());
    std::vector<float> greatest(evidence.data(), evidence.data() + cols), strange(cols);
    for (Eigen::Index y = 0; y < evidence.rows(); ++y)
        compare_row(&evidence(y, 0), static_cast<int>(cols), greatest.data(), strange.data());
    for (const float each : strange)
        if (std::isnan(each)) refuse("evidence", "finite numbers", "others");
    const float most = *std::max_element(greatest.begin(), greatest.end());
    return std::find(evidence.data(), evidence.data() + evidence.size(), most) - evidence.data();
}

double offset_along(const Floats& evidence, Eigen::Index at, Eigen::Index index, Eigen::Index count,
                    Eigen::Index step) {
    if (index < 1 || index > count - 2) return 0.0;
    const float* top = evidence.data() + at;
    return parabola_offset(top[-step], top[0], top[step]);
}

float greatest_near(const FloatStack& responses, int filter, Eigen::Index row, Eigen::Index column) {
    const int y = static_cast<int>(row), x = static_cast<int>(column);
    float most = responses.row(filter, y)[x];
    for (int i = std::max(y - 1, 0); i <= std::min(y + 1, responses.rows - 1); ++i)
        for (int j = std::max(x - 1, 0); j <= std::min(x + 1, responses.cols - 1); ++j)
            most = std::max(most, responses.row(filter, i)[j]);
    return most;
}

void require_arguments(const FloatStack& responses, FloatsRef contrast, const EvidenceWeights& weights) {
    if (responses.planes < 1 || responses.rows < 1 || responses.cols < 1)
        refuse("responses", "at least one filter and cell", "none");
    if (contrast.size() > 0)
        require_shape(contrast.rows(), contrast.cols(), responses.rows, responses.cols, "contrast");
    if (!std::isfinite(weights.filter)) refuse("filter_weight", "a finite number", weights.filter);
    if (!std::isfinite(weights.contrast)) refuse("contrast_weight", "a finite number", weights.contrast);
}

}  // namespace

Vector evidence_peak(const FloatStack& responses, FloatsRef contrast, const EvidenceWeights& weights) {
    require_arguments(responses, contrast, weights);
    const Eigen::Index rows = responses.rows, cols = responses.cols;
    Floats evidence(rows, cols);
    weigh(responses.row(0, 0), static_cast<float>(weights.filter), evidence.size(), evidence.data());
    if (contrast.size() > 0)
        add_weighted(contrast.data(), static_cast<float>(weights.contrast), evidence.size(), evidence.data());
    const Eigen::Index at = find_greatest(evidence), row = at / cols, column = at % cols;

    Vector peak(5 + responses.planes);
    peak[0] = static_cast<double>(column) + offset_along(evidence, at, column, cols, 1) -
              static_cast<double>(cols / 2);
    peak[1] = static_cast<double>(row) + offset_along(evidence, at, row, rows, cols) -
              static_cast<double>(rows / 2);
    peak[2] = evidence.data()[at];
    peak[3] = responses.row(0, 0)[at];
    peak[4] = contrast.size() > 0 ? contrast.data()[at] : 0.0F;
    for (int filter = 0; filter < responses.planes; ++filter)
        peak[5 + filter] = greatest_near(responses, filter, row, column);
    return peak;
}

}  // namespace tricue
