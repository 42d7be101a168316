// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/known_map.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kLargeField_bytes = std::int64_t{8} << 30;
constexpr double kRadius_m = 0.2;
constexpr absl::Duration kScanPatience = absl::Seconds(10);
constexpr int kBeams = 90;
constexpr double kView_m = 1.0;

Scan EmptyPlace() {
  return {-std::numbers::pi, 2.0 * std::numbers::pi / kBeams, kView_m,
          std::vector<float>(kBeams, std::numeric_limits<float>::infinity())};
}

}  // namespace

std::shared_ptr<const Grid<CellState>> KnownHall(int side_cells) {
  const GridGeometry geometry{0.0, 0.0, 0.1, side_cells, side_cells};
  auto map = std::make_shared<Grid<CellState>>(geometry, CellState::kFree);
  for (int i = 0; i < side_cells; ++i) {
    for (const Cell wall :
         {Cell{i, 0}, Cell{i, side_cells - 1}, Cell{0, i}, Cell{side_cells - 1, i}}) {
      (*map)[wall] = CellState::kOccupied;
    }
  }
  return map;
}

std::shared_ptr<const Grid<CellState>> KnownBuilding(const Grid<std::uint8_t>& walls) {
  auto map = std::make_shared<Grid<CellState>>(walls.geometry(), CellState::kFree);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (walls[i] != 0) (*map)[i] = CellState::kOccupied;
  }
  return map;
}

MissionOptions WithMap(std::shared_ptr<const Grid<CellState>> map) {
  const GridGeometry& geometry = map->geometry();
  constexpr std::int64_t kRoom = 2;
  MissionOptions options;
  const auto cells = static_cast<std::int64_t>(map->size());
  options.occupancy.max_cell_count = std::max(options.occupancy.max_cell_count, kRoom * cells);
  options.occupancy.max_cell_count =
      std::min(options.occupancy.max_cell_count, std::int64_t{16'000'000});
  const double extent_m = geometry.resolution_m * std::max(geometry.width, geometry.height);
  options.occupancy.max_extent_m = std::max(options.occupancy.max_extent_m, 1.5 * extent_m);
  options.prior_map = std::move(map);
  return options;
}

MissionOptions LargeField() {
  constexpr int kSide = 1000;  // cells
  MissionOptions options = WithMap(KnownHall(kSide));
  options.gas.field_reach_m = 0.0;
  options.memory_budget_bytes = kLargeField_bytes;
  return options;
}

std::vector<std::string> LargeFieldSettings() {
  return {absl::StrCat("limits.memory_budget_bytes=", kLargeField_bytes),
          absl::StrCat("limits.mission_memory_budget_bytes=", kLargeField_bytes)};
}

absl::StatusOr<client::RobotSession> PlaceRobot(client::PlannerClient& client,
                                                const MissionId& mission, const RobotId& robot,
                                                const Pose2& pose) {
  PLUMESCOUT_ASSIGN_OR_RETURN(client::RobotSession session,
                              client.RegisterRobot(mission, robot, kRadius_m, /*take_over=*/false));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto stream, client.OpenObservationStream(session));
  PLUMESCOUT_RETURN_IF_ERROR(
      stream->Write({{1, absl::ToUnixNanos(absl::Now()), pose, EmptyPlace()}}));
  for (const absl::Time deadline = absl::Now() + kScanPatience; absl::Now() < deadline;) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const client::IngestReply reply, stream->Read(kScanPatience));
    const auto* state = std::get_if<client::IngestState>(&reply);
    if (state != nullptr && state->applied_sequence >= 1) return session;
  }
  return absl::DeadlineExceededError("the scan was not applied");
}

}  // namespace plumescout::lab
