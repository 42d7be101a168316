// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/flow_parts.h"

#include <cmath>

#include "absl/strings/str_cat.h"

namespace plumescout::lab {
namespace {

// What sums of some thousand speeds of up to 30 m/s leave by rounding, with room.
constexpr double kRounding_mps = 1e-8;

// Labels all that a wavefront from `start` reaches through free faces.
void Label(Cell start, int label, const FreeFaces& free, Grid<int>& labels) {
  std::vector<Cell> front = {start};
  labels[start] = label;
  const auto reach = [&](Cell cell) {
    if (labels[cell] != FlowParts::kNone) return;
    labels[cell] = label;
    front.push_back(cell);
  };
  while (!front.empty()) {
    const Cell cell = front.back();
    front.pop_back();
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const Cell next = Plus(cell, Unit(axis));
      if (free.IsFree({cell, axis})) reach(Minus(cell, Unit(axis)));
      if (free.IsFree({next, axis})) reach(next);
    }
  }
}

}  // namespace

FlowParts FindFlowParts(const FlowDomain& domain, const FreeFaces& free) {
  FlowParts result{Grid<int>(domain.fluid.geometry(), FlowParts::kNone), {}};
  for (std::size_t i = 0; i < domain.fluid.size(); ++i) {
    if (domain.fluid[i] == 0 || result.label[i] != FlowParts::kNone) continue;
    const Cell cell = domain.fluid.geometry().CellAtIndex(i);
    Label(cell, static_cast<int>(result.parts.size()), free, result.label);
    result.parts.push_back({cell, false, 0.0});
  }
  const auto part = [&](Cell cell) -> FlowPart& {
    return result.parts[static_cast<std::size_t>(result.label[cell])];
  };
  for (const BoundaryFace& opening : domain.openings) {
    part(opening.cell).has_outlet |= !opening.inflow_mps.has_value();
    part(opening.cell).net_inflow_mps += opening.inflow_mps.value_or(0.0);
  }
  for (const FanFace& fan : domain.fans) {
    part(fan.cell).net_inflow_mps += fan.speed_mps;
    part(FaceOf(fan).behind()).net_inflow_mps -= fan.speed_mps;
  }
  return result;
}

absl::Status CheckContinuity(const FlowParts& parts) {
  for (const FlowPart& part : parts.parts) {
    if (part.has_outlet || std::abs(part.net_inflow_mps) < kRounding_mps) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        "air is driven ", part.net_inflow_mps > 0.0 ? "into" : "out of", " the space around cell (",
        part.first.x, ", ", part.first.y, "), which has no other way for it"));
  }
  return absl::OkStatus();
}

}  // namespace plumescout::lab
