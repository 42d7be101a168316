// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"
#include "plumescout/v1/types.pb.h"

namespace plumescout {

v1::Pose2D ToProto(const Pose2& pose);
v1::Point2D ToProto(const Point2& point);
v1::GridCell ToProto(const Cell& cell);
v1::GridGeometry ToProto(const GridGeometry& geometry);

// Coordinates must be finite; the heading is wrapped into (-pi, pi].
absl::StatusOr<Pose2> FromProto(const v1::Pose2D& proto, absl::string_view field);
absl::StatusOr<Point2> FromProto(const v1::Point2D& proto, absl::string_view field);
Cell FromProto(const v1::GridCell& proto);
// Bounded to kMaxRasterCells cells, so that a reader may allocate what it describes.
absl::StatusOr<GridGeometry> FromProto(const v1::GridGeometry& proto, absl::string_view field);

inline constexpr std::int64_t kMaxRasterCells = 16'000'000;  // the largest mission allowed

}  // namespace plumescout
