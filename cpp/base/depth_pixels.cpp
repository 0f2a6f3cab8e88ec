// SPDX-License-Identifier: MIT
#include "base/depth_pixels.hpp"

#include <cmath>
#include <limits>

#include "base/check.hpp"

namespace tricue {
namespace {

std::vector<float> find_slopes(int n, double focal_length, double center) {
    std::vector<float> slopes(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
        slopes[static_cast<std::size_t>(i)] = static_cast<float>((i - center) / focal_length);
    return slopes;
}

}  // namespace

float round_up_to_float(double s) {
    const auto nearest = static_cast<float>(s);
    return nearest < s ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

void require_camera(VectorRef camera) {
    require_size(camera, 4, "camera");
    require_finite(camera, "camera");
    for (Eigen::Index i = 0; i < 2; ++i)
        if (!(camera[i] > 0.0)) refuse("camera", "focal lengths above 0", camera[i]);
}

void require_object_table(StatesRef table) {
    require_shape(table, table.rows(), 7, "table");
    require_finite(table, "table");
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
        for (Eigen::Index j = 2; j < 4; ++j)
            if (!(table(i, j) > 0.0)) refuse("table", "sizes above 0", table(i, j));
        if (!(table(i, 5) > 0.0)) refuse("table", "depths above 0", table(i, 5));
    }
}

Rays find_rays(VectorRef camera, const DepthView& depth) {
    require_camera(camera);
    return {find_slopes(depth.cols, camera[0], camera[2]), find_slopes(depth.rows, camera[1], camera[3])};
}

}  // namespace tricue
