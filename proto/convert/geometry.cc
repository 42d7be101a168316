// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/geometry.h"

#include "core/types/status_macros.h"
#include "proto/convert/field.h"

namespace plumescout {

v1::Pose2D ToProto(const Pose2& pose) {
  v1::Pose2D proto;
  proto.set_x_m(pose.x_m);
  proto.set_y_m(pose.y_m);
  proto.set_yaw_rad(pose.yaw_rad);
  return proto;
}

v1::Point2D ToProto(const Point2& point) {
  v1::Point2D proto;
  proto.set_x_m(point.x_m);
  proto.set_y_m(point.y_m);
  return proto;
}

v1::GridCell ToProto(const Cell& cell) {
  v1::GridCell proto;
  proto.set_column(cell.x);
  proto.set_row(cell.y);
  return proto;
}

v1::GridGeometry ToProto(const GridGeometry& geometry) {
  v1::GridGeometry proto;
  *proto.mutable_origin() = ToProto(Point2{geometry.origin_x_m, geometry.origin_y_m});
  proto.set_resolution_m(geometry.resolution_m);
  proto.set_column_count(geometry.width);
  proto.set_row_count(geometry.height);
  return proto;
}

absl::StatusOr<Pose2> FromProto(const v1::Pose2D& proto, absl::string_view field) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "x_m"), proto.x_m()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "y_m"), proto.y_m()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "yaw_rad"), proto.yaw_rad()));
  return Pose2{proto.x_m(), proto.y_m(), WrapAngle_rad(proto.yaw_rad())};
}

absl::StatusOr<Point2> FromProto(const v1::Point2D& proto, absl::string_view field) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "x_m"), proto.x_m()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "y_m"), proto.y_m()));
  return Point2{proto.x_m(), proto.y_m()};
}

Cell FromProto(const v1::GridCell& proto) { return {proto.column(), proto.row()}; }

absl::StatusOr<GridGeometry> FromProto(const v1::GridGeometry& proto, absl::string_view field) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 origin,
                              FromProto(proto.origin(), Join(field, "origin")));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive(Join(field, "resolution_m"), proto.resolution_m()));
  const std::string columns = Join(field, "column_count");
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(columns, proto.column_count(), 0, kMaxRasterCells));
  const std::int64_t max_rows = kMaxRasterCells / std::max(proto.column_count(), 1);
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange(Join(field, "row_count"), proto.row_count(), 0, max_rows));
  return GridGeometry{origin.x_m, origin.y_m, proto.resolution_m(), proto.column_count(),
                      proto.row_count()};
}

}  // namespace plumescout
