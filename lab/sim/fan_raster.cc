// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/fan_raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "lab/sim/flow_faces.h"
#include "lab/sim/flow_parts.h"

namespace plumescout::lab {
namespace {

// Fans are drawn on the lines between cells or through cell centres; this much of a metre decides
// for centres that lie on a fan up to rounding.
constexpr double kEdge_m = 1e-9;

// A point as a fan sees it.
struct FanView {
  double ahead_m;   // downwind of the fan
  double across_m;  // from its middle, leftward
};

FanView ViewOf(const Fan& fan, Point2 point) {
  const double east = std::cos(fan.direction_rad);
  const double north = std::sin(fan.direction_rad);
  const double x = point.x_m - fan.position.x_m;
  const double y = point.y_m - fan.position.y_m;
  return {x * east + y * north + kEdge_m, y * east - x * north + kEdge_m};
}

// Whether the fan parts the centres of the two cells.
bool Parts(const Fan& fan, const Face& face, const GridGeometry& geometry) {
  const FanView a = ViewOf(fan, geometry.Center(face.behind()));
  const FanView b = ViewOf(fan, geometry.Center(face.ahead));
  if ((a.ahead_m < 0.0) == (b.ahead_m < 0.0)) return false;
  const double share = a.ahead_m / (a.ahead_m - b.ahead_m);
  const double across_m = a.across_m + share * (b.across_m - a.across_m);
  return across_m >= -0.5 * fan.width_m && across_m < 0.5 * fan.width_m;
}

// All faces that the fan holds, at its speed there.
std::vector<FanFace> FacesOf(const Fan& fan, const GridGeometry& geometry) {
  const double reach_m = 0.5 * fan.width_m + geometry.resolution_m;
  const Point2 center = fan.position;
  const Cell first = geometry.CellAt({center.x_m - reach_m, center.y_m - reach_m});
  const Cell last = geometry.CellAt({center.x_m + reach_m, center.y_m + reach_m});
  std::vector<FanFace> faces;
  for (int y = std::max(0, first.y); y <= std::min(geometry.height - 1, last.y + 1); ++y) {
    for (int x = std::max(0, first.x); x <= std::min(geometry.width - 1, last.x + 1); ++x) {
      const Cell cell{x, y};
      if (Parts(fan, {cell, Axis::kX}, geometry)) {
        faces.push_back({cell, Side::kWest, fan.speed_mps * std::cos(fan.direction_rad)});
      }
      if (Parts(fan, {cell, Axis::kY}, geometry)) {
        faces.push_back({cell, Side::kSouth, fan.speed_mps * std::sin(fan.direction_rad)});
      }
    }
  }
  return faces;
}

absl::Status CheckFace(const std::string& fan, const FanFace& face, const FlowDomain& flow) {
  const Cell cells[] = {face.cell, FaceOf(face).behind()};
  for (const Cell cell : cells) {
    if (flow.fluid.At(cell, 0) != 0) continue;
    const Point2 center = flow.fluid.geometry().Center(cell);
    return absl::InvalidArgumentError(
        absl::StrCat(fan, " reaches into a wall at (", center.x_m, ", ", center.y_m, ")"));
  }
  const bool taken = std::any_of(flow.fans.begin(), flow.fans.end(), [&](const FanFace& other) {
    return other.cell == face.cell && other.side == face.side;
  });
  if (!taken) return absl::OkStatus();
  return absl::InvalidArgumentError(fan + " overlaps another fan");
}

absl::Status AddFan(const std::string& name, const Fan& fan, FlowDomain& flow) {
  const GridGeometry& geometry = flow.fluid.geometry();
  const std::vector<FanFace> faces = FacesOf(fan, geometry);
  if (faces.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(name, ".width_m = ", fan.width_m,
                                                   " is too narrow for cells of ",
                                                   geometry.resolution_m, " m"));
  }
  for (const FanFace& face : faces) PLUMESCOUT_RETURN_IF_ERROR(CheckFace(name, face, flow));
  flow.fans.insert(flow.fans.end(), faces.begin(), faces.end());
  return absl::OkStatus();
}

}  // namespace

absl::Status AddFans(const std::vector<Fan>& fans, FlowDomain& flow) {
  for (std::size_t i = 0; i < fans.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(AddFan(absl::StrCat("fans[", i, "]"), fans[i], flow));
  }
  if (fans.empty()) return absl::OkStatus();
  const absl::Status status = CheckContinuity(FindFlowParts(flow, FreeFaces(flow)));
  if (status.ok()) return status;
  return absl::InvalidArgumentError(absl::StrCat("fans: ", status.message()));
}

}  // namespace plumescout::lab
