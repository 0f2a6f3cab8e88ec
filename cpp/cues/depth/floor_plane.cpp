// SPDX-License-Identifier: MIT
#include "cues/depth/floor_plane.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Eigen::Vector3d;

constexpr int kRefits = 3;
constexpr double kMinSineSquared = 1e-4;  // square of the smallest sine between two edges of a triple
constexpr double kMinViewSine = 1e-3;
constexpr std::ptrdiff_t kBlock = 512;

struct Plane {
    Vector3d n;
    double d;
};

/// The plane and tolerance in float32, for the loops that count.
struct Slab {
    float nx, ny, nz, d, tolerance;

    Slab(const Plane& plane, double t)
        : nx(static_cast<float>(plane.n[0])),
          ny(static_cast<float>(plane.n[1])),
          nz(static_cast<float>(plane.n[2])),
          d(static_cast<float>(plane.d)),
          tolerance(static_cast<float>(t)) {}
};

/// The measured pixels back-projected, one array per coordinate.
struct Points {
    std::vector<float> x, y, z;

    std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(z.size()); }
};

struct Count {
    int within = 0, below = 0;

    int score() const { return within - 3 * below; }
};

double dot(const Vector3d& a, const Vector3d& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void require_level(const LevelRule& level) {
    require_size(level.up, 3, "up");
    require_finite(level.up, "up");
    const double length = std::sqrt(dot(level.up.matrix(), level.up.matrix()));
    if (!(std::abs(length - 1.0) <= 1e-6)) refuse("up", "a vector of length 1", length);
    if (!(level.min_cosine >= -1.0 && level.min_cosine <= 1.0))
        refuse("min_cosine", "a number in [-1, 1]", level.min_cosine);
}

void require_indices(TriplesRef triples, const DepthView& depth) {
    const std::int64_t pixels = std::int64_t{depth.rows} * depth.cols;
    for (Eigen::Index i = 0; i < triples.size(); ++i) {
        const std::int64_t index = triples.data()[i];
        if (index < 0 || index >= pixels)
            refuse("triples", "indices in [0, " + std::to_string(pixels) + ")", std::to_string(index));
    }
}

Points measured_points(const DepthView& depth, const Rays& rays) {
    Points points;
    const std::size_t most = rays.x.size() * rays.y.size();
    for (auto* values : {&points.x, &points.y, &points.z}) values->resize(most);
    std::size_t count = 0;
    for (std::size_t v = 0; v < rays.y.size(); ++v) {
        const float* row = depth.row(static_cast<int>(v));
        for (std::size_t u = 0; u < rays.x.size();
             ++u) {  // without a branch: the next pixel overwrites an unmeasured one
            points.x[count] = rays.x[u] * row[u];
            points.y[count] = rays.y[v] * row[u];
            points.z[count] = row[u];
            count += has_depth(row[u]);
        }
    }
    for (auto* values : {&points.x, &points.y, &points.z}) values->resize(count);
    return points;
}

/// NaN where the pixel wasn't measured.
Vector3d point_at(const DepthView& depth, const Rays& rays, std::int64_t index) {
    const auto v = static_cast<int>(index / depth.cols), u = static_cast<int>(index % depth.cols);
    const float z = depth.row(v)[u];
    if (!has_depth(z)) return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    return {rays.x[static_cast<std::size_t>(u)] * z, rays.y[static_cast<std::size_t>(v)] * z, z};
}

/// The plane through a point, oriented so that the camera is above it; nothing if it isn't level enough, or is seen edge-on.
std::optional<Plane> level_plane(const Vector3d& normal, const Vector3d& point, const LevelRule& level) {
    Plane plane{normal, -dot(normal, point)};
    if (plane.d < 0.0) plane = {-plane.n, -plane.d};
    const bool visible = plane.d > kMinViewSine * std::sqrt(dot(point, point));
    if (visible && dot(plane.n, level.up.matrix()) >= level.min_cosine) return plane;
    return {};
}

std::optional<Plane> plane_through(const Vector3d& p, const Vector3d& q, const Vector3d& r,
                                   const LevelRule& level) {
    const Vector3d a = q - p, b = r - p, normal = a.cross(b);
    const double square = dot(normal, normal);
    if (!(square > kMinSineSquared * dot(a, a) * dot(b, b))) return {};  // NaN too
    return level_plane(normal / std::sqrt(square), p, level);
}

TRICUE_MULTIVERSION
Count count_block(const float* __restrict x, const float* __restrict y, const float* __restrict z,
                  std::ptrdiff_t n, const Slab& slab) {
    const auto [nx, ny, nz, d, tolerance] = slab;
    const float deep = -3.0f * tolerance;
    int within = 0, below = 0;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const float h = ((nx * x[i] + ny * y[i]) + nz * z[i]) + d;
        within += std::abs(h) <= tolerance;
        below += h < deep;
    }
    return {within, below};
}

/// Stops early once the score can't exceed `beat` anymore.
Count count_points(const Points& points, const Slab& slab, int beat) {
    Count count;
    for (std::ptrdiff_t i = 0; i < points.size(); i += kBlock) {
        if (count.score() + (points.size() - i) <= beat) break;
        const Count block =
            count_block(&points.x[static_cast<std::size_t>(i)], &points.y[static_cast<std::size_t>(i)],
                        &points.z[static_cast<std::size_t>(i)], std::min(kBlock, points.size() - i), slab);
        count.within += block.within;
        count.below += block.below;
    }
    return count;
}

TRICUE_MULTIVERSION
void mark_within(const float* __restrict x, const float* __restrict y, const float* __restrict z,
                 std::ptrdiff_t n, const Slab& slab, std::uint8_t* __restrict within) {
    const auto [nx, ny, nz, d, tolerance] = slab;
    for (std::ptrdiff_t i = 0; i < n; ++i)
        within[i] = std::abs(((nx * x[i] + ny * y[i]) + nz * z[i]) + d) <= tolerance;
}

/// Least squares in one pass. Sums are relative to the first point, so that subtracting the mean loses little precision.
std::optional<Plane> fit_plane(const Points& points, const Slab& slab, const LevelRule& level) {
    std::vector<std::uint8_t> within(points.z.size());
    mark_within(points.x.data(), points.y.data(), points.z.data(), points.size(), slab, within.data());
    const auto first =
        static_cast<std::size_t>(std::find(within.begin(), within.end(), std::uint8_t{1}) - within.begin());
    if (first == within.size()) return {};
    const double x0 = points.x[first], y0 = points.y[first], z0 = points.z[first];
    double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    for (std::size_t i = first; i < within.size(); ++i) {
        if (!within[i]) continue;
        const double a = points.x[i] - x0, b = points.y[i] - y0, c = points.z[i] - z0;
        n += 1, x += a, y += b, z += c;
        xx += a * a, xy += a * b, xz += a * c, yy += b * b, yz += b * c, zz += c * c;
    }
    if (n < 3) return {};
    const Vector3d mean = Vector3d(x, y, z) / n;
    Eigen::Matrix3d covariance;
    covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    covariance = covariance / n - mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    return level_plane(solver.eigenvectors().col(0), mean + Vector3d(x0, y0, z0), level);
}

}  // namespace

Vector floor_plane(const DepthView& depth, VectorRef camera, TriplesRef triples, double tolerance,
                   const LevelRule& level) {
    const Rays lens = find_rays(camera, depth);
    require_positive(tolerance, "tolerance");
    require_level(level);
    require_indices(triples, depth);
    const Points points = measured_points(depth, lens);
    std::optional<Plane> best;
    int score = 0;
    for (Eigen::Index k = 0; k < triples.rows(); ++k) {
        const auto plane =
            plane_through(point_at(depth, lens, triples(k, 0)), point_at(depth, lens, triples(k, 1)),
                          point_at(depth, lens, triples(k, 2)), level);
        const int plane_score = plane ? count_points(points, {*plane, tolerance}, score).score() : 0;
        if (plane_score > score) {
            best = plane;
            score = plane_score;
        }
    }
    if (!best) return Vector::Zero(6);
    for (int round = 0; round < kRefits; ++round)
        best = fit_plane(points, {*best, tolerance}, level).value_or(*best);
    const Count count = count_points(points, {*best, tolerance}, std::numeric_limits<int>::min());
    const auto all = static_cast<double>(points.size());
    Vector result(6);
    result << best->n.array(), best->d, count.within / all, count.below / all;
    return result;
}

}  // namespace tricue
