// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/planner_client.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/ids.h"
#include "core/types/options.h"

namespace plumescout::lab {

// A square hall of free cells within walls, cells of 0.1 m: what compresses best.
std::shared_ptr<const Grid<CellState>> KnownHall(int side_cells);
// The building of MakeBuilding, known from the start.
std::shared_ptr<const Grid<CellState>> KnownBuilding(const Grid<std::uint8_t>& walls);

// A mission that begins with the map and allows as many cells.
MissionOptions WithMap(std::shared_ptr<const Grid<CellState>> map);
// One in a hall of a million cells, on all of which the gas is computed at full resolution; for a
// server with these settings.
MissionOptions LargeField();
std::vector<std::string> LargeFieldSettings();

// Registers a robot and has one scan of an empty place applied, taken at `pose`: now it can be
// planned for.
absl::StatusOr<client::RobotSession> PlaceRobot(client::PlannerClient& client,
                                                const MissionId& mission, const RobotId& robot,
                                                const Pose2& pose);

}  // namespace plumescout::lab
