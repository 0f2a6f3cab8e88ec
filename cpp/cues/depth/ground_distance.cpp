// SPDX-License-Identifier: MIT
#include "cues/depth/ground_distance.hpp"

#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

struct Limits {
    float near, far;
};

/// What is NaN stays NaN: no comparison with it holds.
TRICUE_MULTIVERSION
void measure_row(const float* __restrict depth, const double* __restrict across, int n, double down,
                 const Limits& limits, float* __restrict distance) {
    const auto [near, far] = limits;
    for (int u = 0; u < n; ++u) {
        const float along = depth[u] * static_cast<float>(down + across[u]);
        const float least = along < near ? near : along;
        distance[u] = least > far ? far : least;
    }
}

/// In the twin's order.
double norm(VectorRef v) {
    return std::sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
}

void require_limits(double near, double far) {
    if (!std::isfinite(near)) refuse("near", "a finite number", near);
    if (!(std::isfinite(far) && far > near)) refuse("far", "a finite number above near", far);
}

}  // namespace

Floats ground_distance(const DepthView& depth, VectorRef camera, VectorRef up, double near, double far) {
    require_camera(camera);
    require_size(up, 3, "up");
    require_finite(up, "up");
    const double length = norm(up);
    if (!(std::abs(length - 1.0) <= 1e-6)) refuse("up", "a vector of length 1", length);
    require_limits(near, far);
    Vector ahead(3);
    ahead << -up[2] * up[0], -up[2] * up[1], 1.0 - up[2] * up[2];
    const double level = norm(ahead);
    if (!(level > 1e-6)) refuse("up", "a direction across the view", "one along it");
    ahead /= level;
    std::vector<double> across(static_cast<std::size_t>(depth.cols));
    for (int u = 0; u < depth.cols; ++u)
        across[static_cast<std::size_t>(u)] = ahead[0] * ((u - camera[2]) / camera[0]);
    const Limits limits{static_cast<float>(near), std::nextafter(static_cast<float>(far), 0.0F)};
    Floats distance(depth.rows, depth.cols);
    for (int v = 0; v < depth.rows; ++v)
        measure_row(depth.row(v), across.data(), depth.cols,
                    ahead[1] * ((v - camera[3]) / camera[1]) + ahead[2], limits, distance.row(v).data());
    return distance;
}

}  // namespace tricue
