// SPDX-License-Identifier: MIT
#include "base/ellipse_shape.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/check.hpp"

namespace tricue {
namespace {

constexpr double kMaxSemiAxis = 4096.0, kMaxCoordinate = 1 << 30;

int to_int(double value) {
    return static_cast<int>(value);
}

int pixel_of(double place) {
    return to_int(std::floor(std::clamp(place, -kMaxCoordinate, kMaxCoordinate)));
}

/// The pixels whose centers are within `reach` of a place.
EllipseShape::Run pixels_within(double place, double reach) {
    return {to_int(std::ceil(place - reach - 0.5)), to_int(std::floor(place + reach - 0.5)) + 1};
}

}  // namespace

CenterPixel::CenterPixel(const double* ellipse) : x(pixel_of(ellipse[0])), y(pixel_of(ellipse[1])) {}

EllipseShape::EllipseShape(const double* ellipse, double scale) {
    const double x = ellipse[0] - std::floor(ellipse[0]), y = ellipse[1] - std::floor(ellipse[1]);
    const double minor = scale * ellipse[2], major = scale * ellipse[3];
    const Run rows = pixels_within(y, major);
    runs.reserve(static_cast<std::size_t>(std::max(rows.end - rows.begin, 0)));
    for (int row = rows.begin; row < rows.end; ++row) {
        const double v = (row + 0.5 - y) / major;
        const Run pixels = pixels_within(x, minor * std::sqrt(std::max(1.0 - v * v, 0.0)));
        if (pixels.begin >= pixels.end) continue;
        if (runs.empty()) top = row;
        runs.push_back(pixels);
        area += pixels.end - pixels.begin;
    }
}

EllipseShape::Run EllipseShape::column_range() const {
    Run all{0, 0};
    for (const Run& row : runs) all = {std::min(all.begin, row.begin), std::max(all.end, row.end)};
    return all;
}

void require_ellipse(VectorRef ellipse, double margin) {
    require_size(ellipse, 4, "ellipse");
    require_finite(ellipse, "ellipse");
    if (!(margin >= 1.0 && margin <= 16.0)) refuse("margin", "1 to 16", margin);
    const auto [least, most] = std::minmax({ellipse[2], ellipse[3]});
    if (!(least > 0.0)) refuse("ellipse", "semi-axes above 0", least);
    if (margin * most > kMaxSemiAxis)
        refuse("ellipse",
               std::string("semi-axes of at most 4096 pixels") + (margin > 1.0 ? " with the margin" : ""),
               margin * most);
}

}  // namespace tricue
