// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "lab/sim/flow_domain.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// Cells of 0.1 m, all of air, walls around.
inline FlowDomain ClosedRoom(int width, int height) {
  FlowDomain domain;
  GridGeometry geometry;
  geometry.width = width;
  geometry.height = height;
  domain.fluid = Grid<std::uint8_t>(geometry, 1);
  return domain;
}

// Air in through the west side, out through the east side, walls in the south and the north.
inline FlowDomain Channel(int length, int rows, double inflow_mps) {
  FlowDomain domain = ClosedRoom(length, rows);
  for (int y = 0; y < rows; ++y) {
    domain.openings.push_back({{0, y}, Side::kWest, inflow_mps});
    domain.openings.push_back({{length - 1, y}, Side::kEast, std::nullopt});
  }
  return domain;
}

// Largest |net outflow| of any fluid cell.
inline double WorstNetOutflow_mps(const FlowDomain& domain, const MacField& field) {
  double worst = 0.0;
  for (std::size_t i = 0; i < domain.fluid.size(); ++i) {
    if (domain.fluid[i] == 0) continue;
    const Cell cell = domain.fluid.geometry().CellAtIndex(i);
    worst = std::max(worst, std::abs(field.NetOutflow_mps(cell)));
  }
  return worst;
}

}  // namespace plumescout::lab
