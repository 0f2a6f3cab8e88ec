// SPDX-License-Identifier: MIT
#include "cues/depth/ground_distance.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void measure_row(const float* __restrict depth, const double* __restrict across, int n, double down,
                 float near, float far, float* __restrict distance) {
    for (int u = 0; u < n; ++u) distance[u] = along_ground(depth[u], down + across[u], near, far);
}

/// Added up in the twin's order.
double norm(VectorRef v) {
    return std::sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
}

void require_limits(double near, double far) {
    if (!std::isfinite(near)) refuse("near", "a finite number", near);
    if (!(std::isfinite(far) && far > near)) refuse("far", "a finite number above near", far);
}

}  // namespace

GroundView::GroundView(int rows, int cols, VectorRef camera, VectorRef up, double near_, double far_)
    : near(static_cast<float>(near_)), far(std::nextafter(static_cast<float>(far_), 0.0F)) {
    require_camera(camera);
    require_size(up, 3, "up");
    require_finite(up, "up");
    const double length = norm(up);
    if (!(std::abs(length - 1.0) <= 1e-6)) refuse("up", "a vector of length 1", length);
    require_limits(near_, far_);
    Vector ahead(3);
    // Not 1 - up_z²: for a camera that looks straight down, little but the error of up's length would be left.
    ahead << -up[2] * up[0], -up[2] * up[1], up[0] * up[0] + up[1] * up[1];
    const double level = norm(ahead);
    if (!(level > 1e-6)) refuse("up", "a direction across the view", "one along it");
    ahead /= level;
    across.reserve(static_cast<std::size_t>(cols));
    for (int u = 0; u < cols; ++u) across.push_back(ahead[0] * ((u - camera[2]) / camera[0]));
    down.reserve(static_cast<std::size_t>(rows));
    for (int v = 0; v < rows; ++v) down.push_back(ahead[1] * ((v - camera[3]) / camera[1]) + ahead[2]);
}

Floats ground_distance(const DepthView& depth, VectorRef camera, VectorRef up, double near, double far) {
    const GroundView ground(depth.rows, depth.cols, camera, up, near, far);
    Floats distance(depth.rows, depth.cols);
    for (int v = 0; v < depth.rows; ++v)
        measure_row(depth.row(v), ground.across.data(), depth.cols, ground.down[static_cast<std::size_t>(v)],
                    ground.near, ground.far, distance.row(v).data());
    return distance;
}

}  // namespace tricue
