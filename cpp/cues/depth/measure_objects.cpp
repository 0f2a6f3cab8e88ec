// SPDX-License-Identifier: MIT
#include "cues/depth/measure_objects.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;
using Vector3 = Eigen::Vector3d;

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

/// The direction along the ground in which an upright object has one distance, though not one depth if the camera is tilted.
Vector3 ahead_of(const Ground& ground) {
    const Vector3 up = ground.plane.head(3).matrix();
    return Vector3::UnitZ() - up.z() * up;
}

/// The strip from the lower edge of an object down to the floor, at the object's depth; 0 where it doesn't stand there.
double strip_to_floor(const Object& object, const Ground& ground) {
    const Vector3 up = ground.plane.head(3).matrix(), ahead = ahead_of(ground);
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

void extend_to_floor(Object& object, double strip) {
    object.y += strip / 2;
    object.height += strip;
}

/// How far the mean of an upright object's points is below the middle of its box, which ends with a strip that is filled like the
/// rest. Each row counts at its own depth.
double mean_below(const Object& object, double strip, FloatsRef rows, Index i, const Vector3& ahead) {
    const double top = object.y - object.height / 2, visible = object.height - strip;
    const auto along = [&](double y) { return ahead.dot(Vector3(object.x, y, object.z)); };
    const bool in_front = along(top) > 0.0 && along(top + object.height) > 0.0;
    const auto nearness = [&](double y) { return in_front ? along(y) : object.z; };
    double depths = 0.0, places = 0.0;  // over the same number, which makes the mean depth that of the object
    for (Index b = 0; b < rows.cols(); ++b) {
        const double y = top + visible * ((static_cast<double>(b) + 0.5) / static_cast<double>(rows.cols()));
        const double depth = static_cast<double>(rows(i, b)) / nearness(y);
        depths += depth;
        places += depth * y;
    }
    if (!(depths > 0.0)) return 0.0;
    const double share = strip / object.height, feet = top + visible + strip / 2;
    return ((1.0 - share) * places + share * feet / nearness(feet)) / depths - object.y;
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
    require_not_negative(ground.feet, "feet");
}

}  // namespace

States measure_objects(const ObjectTable& objects, VectorRef camera, const Ground& ground) {
    require_camera(camera);
    require_arguments(objects, ground);
    const bool floor = (ground.plane != 0.0).any();
    States measured(objects.table.rows(), 8);
    for (Index i = 0; i < measured.rows(); ++i) {
        Object object = to_metric(objects, i, camera);
        if (floor) {
            const double strip = objects.cut(i, 3) ? 0.0 : strip_to_floor(object, ground);
            extend_to_floor(object, strip);
            object.shift_y = mean_below(object, strip, objects.rows, i, ahead_of(ground));
        }
        measured.row(i) << object.x, object.y, object.z, object.width, object.height, object.shift_x,
            object.shift_y, object.area;
    }
    return measured;
}

}  // namespace tricue
