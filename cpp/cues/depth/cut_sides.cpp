// SPDX-License-Identifier: MIT
#include "cues/depth/cut_sides.hpp"

#include "base/check.hpp"
#include "base/depth_pixels.hpp"

namespace tricue {
namespace {

constexpr int kSamplesPerSide = 12;

/// The box enlarged by `beside` on every side, pixels, and the depth below which something is in front of its object, meters.
struct ExpandedBox {
    double x, y, half_width, half_height, limit;
};

bool is_nearer(const DepthView& depth, double x, double y, double limit) {
    const bool inside = x >= 0.0 && x < depth.cols && y >= 0.0 && y < depth.rows;
    if (!inside) return false;
    const float z = depth.row(static_cast<int>(y))[static_cast<int>(x)];
    return has_depth(z) && z < limit;
}

/// Whether more than a share of the places between two corners, in half sizes from the center, are nearer.
bool is_side_covered(const DepthView& depth, const ExpandedBox& box, double u0, double v0, double u1,
                     double v1, double share) {
    int nearer = 0;
    for (int i = 0; i < kSamplesPerSide; ++i) {
        const double t = (i + 0.5) / kSamplesPerSide, u = u0 + t * (u1 - u0), v = v0 + t * (v1 - v0);
        nearer += is_nearer(depth, box.x + u * box.half_width, box.y + v * box.half_height, box.limit);
    }
    return static_cast<double>(nearer) / kSamplesPerSide > share;
}

void require_arguments(StatesRef table, VectorRef camera, const Cut& cut) {
    require_object_table(table);
    require_camera(camera);
    if (cut.border < 0) refuse("border", "no negative number", cut.border);
    require_not_negative(cut.beside, "beside");
    require_not_negative(cut.occluder_margin, "occluder_margin");
    if (!(cut.share >= 0.0 && cut.share <= 1.0)) refuse("share", "a number in [0, 1]", cut.share);
}

}  // namespace

Flags cut_sides(const DepthView& depth, StatesRef table, VectorRef camera, const Cut& cut) {
    require_arguments(table, camera, cut);
    Flags sides(table.rows(), 4);
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
        const double x = table(i, 0), y = table(i, 1), w = table(i, 2), h = table(i, 3), z = table(i, 5);
        const ExpandedBox box{x + w / 2, y + h / 2, w / 2 + cut.beside * camera[0] / z,
                              h / 2 + cut.beside * camera[1] / z, z - cut.occluder_margin};
        const auto covered = [&](double u0, double v0, double u1, double v1) {
            return is_side_covered(depth, box, u0, v0, u1, v1, cut.share);
        };
        sides(i, 0) = x < cut.border || covered(-1, -1, -1, 1);
        sides(i, 1) = x + w > depth.cols - cut.border || covered(1, -1, 1, 1);
        sides(i, 2) = y < cut.border || covered(-1, -1, 1, -1);
        sides(i, 3) = y + h > depth.rows - cut.border || covered(-1, 1, 1, 1);
    }
    return sides;
}

}  // namespace tricue
