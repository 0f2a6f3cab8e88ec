// SPDX-License-Identifier: MIT
#include "cues/depth/measure_objects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

struct Object {
    double x, y, z, width, height, shift_x, shift_y, area;
};

/// The mean of a histogram over equal parts of [-1/2, 1/2].
double mean_place(FloatsRef shares, Index row) {
    const auto bins = static_cast<double>(shares.cols());
    double mean = 0.0;
    for (Index b = 0; b < shares.cols(); ++b)
        mean += static_cast<double>(shares(row, b)) * ((static_cast<double>(b) + 0.5) / bins - 0.5);
    return mean;
}

Object to_metric(const ObjectTable& objects, Index i, VectorRef camera) {
    const auto box = objects.table.row(i);
    const double z = box[5], per_x = z / camera[0], per_y = z / camera[1];
    const double width = box[2] * per_x, height = box[3] * per_y;
    return {(box[0] + box[2] / 2 - 0.5 - camera[2]) * per_x,
            (box[1] + box[3] / 2 - 0.5 - camera[3]) * per_y,
            z,
            width,
            height,
            mean_place(objects.columns, i) * width,
            mean_place(objects.rows, i) * height,
            box[4] * per_x * per_y};
}

/// The strip from the lower edge of an object down to the floor, at the object's depth; 0 where it doesn't stand there.
///
/// For a tilted camera, an upright object has a single distance along the ground, but its feet have another depth.
double strip_to_floor(const Object& object, const Ground& ground) {
    using Vector3 = Eigen::Vector3d;
    const Vector3 up = ground.plane.head(3).matrix(), ahead = Vector3::UnitZ() - up.z() * up;
    const Vector3 center(object.x, object.y, object.z),
        edge = center + Vector3::UnitY() * (object.height / 2);
    const double along = ahead.dot(edge);
    if (!(along > 0.0)) return 0.0;
    const Vector3 lowest = edge * (ahead.dot(center) / along);
    const double height = up.dot(lowest) + ground.plane[3];
    if (!(height > 0.0 && height < ground.feet)) return 0.0;
    const Vector3 feet = lowest - height * up;
    return feet.z() > 0.0 ? std::max(feet.y() * (object.z / feet.z()) - edge.y(), 0.0) : 0.0;
}

void extend_to_floor(Object& object, double strip, double legs) {
    object.y += strip / 2;
    object.height += strip;
    object.shift_y -= strip / 2;
    const double share = legs * strip / object.height, middle = (object.height - strip) / 2;
    object.shift_y += share * (middle - object.shift_y);
}

void require_finite_shares(FloatsRef shares, const char* name) {
    for (Index i = 0; i < shares.size(); ++i)
        if (!std::isfinite(shares.data()[i])) refuse(name, "finite numbers", double{shares.data()[i]});
}

void require_arguments(const ObjectTable& objects, const Ground& ground) {
    const Index count = objects.table.rows();
    require_object_table(objects.table);
    require_rows(objects.columns.rows(), count, "columns");
    require_rows(objects.rows.rows(), count, "rows");
    require_rows(objects.cut.rows(), count, "cut");
    require_finite_shares(objects.columns, "columns");
    require_finite_shares(objects.rows, "rows");
    require_size(ground.plane, 4, "plane");
    require_finite(ground.plane, "plane");
    for (const auto& [value, name] : {std::pair{ground.feet, "feet"}, std::pair{ground.legs, "legs"}})
        require_not_negative(value, name);
}

}  // namespace

States measure_objects(const ObjectTable& objects, VectorRef camera, const Ground& ground) {
    require_camera(camera);
    require_arguments(objects, ground);
    const bool floor = (ground.plane != 0.0).any();
    States measured(objects.table.rows(), 8);
    for (Index i = 0; i < measured.rows(); ++i) {
        Object object = to_metric(objects, i, camera);
        const double strip = floor && !objects.cut(i, 3) ? strip_to_floor(object, ground) : 0.0;
        if (strip > 0.0) extend_to_floor(object, strip, ground.legs);
        measured.row(i) << object.x, object.y, object.z, object.width, object.height, object.shift_x,
            object.shift_y, object.area;
    }
    return measured;
}

}  // namespace tricue
