// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Poses that were wrong: robots that lose their place, corrections, the map rebuilt with them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "core/mission/observation_check.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr std::int64_t kHistoryShare = 4;  // a quarter of the budget at most

absl::Status CheckTimes(const PoseCorrection& correction, std::int64_t own_ns) {
  const std::int64_t last_ns = correction.anchors.back().sample_time_ns;
  if (last_ns <= own_ns) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      "correction.anchors[", correction.anchors.size() - 1, "].sample_time_ns = ", last_ns,
      " must not be after the correction's own, ", own_ns));
}

}  // namespace

// Times of the past are taken as those of what was measured then, whatever became of the clock.
absl::Status Mission::TakeCorrection(const RobotId& robot, const Observation& observation,
                                     const PoseCorrection& correction) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckTimes(correction, observation.sample_time_ns));
  const std::int64_t time_ns = MissionTime_ns(observation, fleet_.StateOf(robot).clock_offset_ns);
  std::vector<PoseAnchor> anchors = correction.anchors;
  std::int64_t before_ns = std::numeric_limits<std::int64_t>::min();
  for (PoseAnchor& anchor : anchors) {
    before_ns = std::max(before_ns + 1, fleet_.MissionTime_ns(robot, anchor.sample_time_ns));
    anchor.sample_time_ns = before_ns;
    anchor.pose = fleet_.InMission(robot, anchor.pose);
  }
  PLUMESCOUT_RETURN_IF_ERROR(
      history_.CheckCorrection(robot, time_ns, anchors, UntoldPoints(robot)));
  FinishWays(robot, LaggingSensors(robot));
  const std::int64_t doubtful_from =
      jump_watch_.IsSuspect(robot) ? jump_watch_.DoubtfulFrom(robot) : history_.next_number();
  std::optional<WayPoint> start = fleet_.StartOf(robot);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const WayHistory::Corrected made,
      history_.Correct(robot, time_ns, anchors, doubtful_from, start ? &*start : nullptr));
  if (start) fleet_.MoveStart(robot, start->pose.position());
  const bool misled = made.moved_m >= options_->misleading_move_m;
  if (made.covers_doubt || (misled && !jump_watch_.IsSuspect(robot))) TrustAgain(robot);
  PlaceReadingsAgain();
  if (misled) {
    map_fault_ = MapFault::kMisleads;
  } else if (map_fault_ == MapFault::kNone) {
    map_fault_ = MapFault::kSlight;
  }
  return absl::OkStatus();
}

void Mission::TrustAgain(const RobotId& robot) {
  FinishWays(robot, LaggingSensors(robot));  // what is not told yet is of the doubt
  jump_watch_.Trust(robot, history_.next_number());
  fleet_.Suspect(robot, false);
}

// Where a way now leads the gas field is computed, too.
void Mission::PlaceReadingsAgain() {
  const std::vector<WayHistory::Heard> heard = history_.HeardReadings();
  std::vector<ReadingStore> readings = history_.Readings(heard);
  std::vector<SensorOffsets> sensors = Sensors(heard);
  for (std::size_t i = 0; i < gas_.count(); ++i) {
    gas_[i].ReplaceReadings(std::move(readings[i]), std::move(sensors[i]));
  }
  sampled_cells_ = history_.Sampled(heard);
  for (GasField& gas : rasters_.gas) gas.sampled_cells = nullptr;
  sampled_since_snapshot_ = true;
  gas_changed_since_snapshot_ = true;
  for (const WayHistory::Heard& one : heard) region_.Visit(one.place);
}

// What each sensor with an unknown offset read, and where it met others; what was merged is of no
// sensor any more.
std::vector<SensorOffsets> Mission::Sensors(const std::vector<WayHistory::Heard>& heard) const {
  std::vector<SensorOffsets> sensors;
  for (const GasOptions& gas : GasOptionsOfAll(*options_)) {
    sensors.emplace_back(gas, options_->occupancy.resolution_m);
  }
  if (!fleet_.has_offsets()) return sensors;
  for (const WayHistory::Heard& one : heard) {
    if (one.is_part) continue;
    sensors[one.species].Add(one.source, one.time_ns, one.place, one.reading, GridGeometry());
  }
  return sensors;
}

// By a map that is known to be wrong nobody is judged, but by one that is a little out: a robot
// that corrects its poses each second has it rebuilt all the time.
bool Mission::IsInDoubt(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                        const Scan& scan, const std::vector<MaskDisc>& masks, bool& turned) {
  if (!history_.keeps()) return false;
  const bool misleads = map_fault_ == MapFault::kMisleads ||
                        (rebuild_ != nullptr && rebuild_->fault() == MapFault::kMisleads);
  if (misleads) return jump_watch_.IsSuspect(robot);
  const JumpVerdict verdict = jump_watch_.Note(robot, history_.next_number(), time_ns,
                                               FitOf(pose, scan, masks, occupancy_));
  switch (verdict) {
    case JumpVerdict::kTrusted:
      return false;
    case JumpVerdict::kSuspect:
      return true;
    case JumpVerdict::kFitsAgain:  // what is in quarantine stays there: a correction may yet come
      TrustAgain(robot);
      return false;
    case JumpVerdict::kTurnsSuspect:
      break;
  }
  turned = true;
  fleet_.Suspect(robot, true);
  history_.Quarantine(robot, jump_watch_.DoubtfulFrom(robot));
  PlaceReadingsAgain();
  map_fault_ = MapFault::kMisleads;
  return true;
}

void Mission::TrimHistory() {
  if (rebuild_ != nullptr || !history_.keeps()) return;  // the rebuild counts on what is there
  const std::int64_t budget_bytes = options_->memory_budget_bytes;
  history_.Trim(std::min(budget_bytes / kHistoryShare, budget_bytes - Use().Total_bytes()));
  if (history_.keeps()) return;
  map_fault_ = MapFault::kNone;
  for (const RobotId& robot : fleet_.Ids()) {
    if (fleet_.StateOf(robot).frame_suspect) TrustAgain(robot);
  }
}

absl::StatusOr<Applied> Mission::Change(const MapRebuildBegun&) {
  if (rebuild_ != nullptr) {
    return absl::FailedPreconditionError("a rebuild of the map is under way already");
  }
  if (!history_.keeps()) {
    return absl::FailedPreconditionError("nothing is kept that the map could be rebuilt from");
  }
  OccupancyGrid base = history_.Base();
  base.LimitCells(MostMapCells());
  history_.CloseKeyScans();
  rebuild_ = std::make_shared<MapRebuild>(
      RebuildInputs{sample_time_ns_, history_.next_number() - 1, std::move(base),
                    history_.ScansFrom(0), stop_, std::exchange(map_fault_, MapFault::kNone)});
  return Applied{};
}

absl::StatusOr<Applied> Mission::Change(const MapRebuilt&) {
  if (rebuild_ == nullptr) return absl::FailedPreconditionError("no map is being rebuilt");
  rebuild_->Recompute();
  if (!rebuild_->done()) return absl::CancelledError("a rebuild of the map is abandoned");
  const std::shared_ptr<MapRebuild> rebuild = std::exchange(rebuild_, nullptr);
  rebuilt_ns_ = sample_time_ns_;
  OccupancyGrid rebuilt = rebuild->TakeGrid();
  rebuilt.LimitCells(MostMapCells());
  InsertAll(history_.ScansFrom(rebuild->last_number() + 1), StopFn(), rebuilt);
  TrimHistory();
  // The map never becomes smaller: cells that nobody saw from the right places are unknown.
  const GridGeometry& before = occupancy_.geometry();
  if (before.size() > 0) {
    Applied kept;  // a map of both extents may be larger than maps may be: then the old one stays
    kept.map = rebuilt.GrowToContain(before.Center({1, 1}),
                                     before.Center({before.width - 2, before.height - 2}));
    if (!kept.map.ok()) return kept;
  }
  occupancy_ = std::move(rebuilt);
  region_.Follow(occupancy_.geometry());
  map_changed_since_refresh_ = true;
  map_changed_since_snapshot_ = true;
  return Applied{};
}

}  // namespace plumescout
