// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Gas readings: of sensors that show the air where they are, and of those that lag behind.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"

namespace plumescout {

WayModel Mission::ModelOf(const GasSensor& sensor) const {
  const std::size_t species = FindSpecies(*options_, sensor.species).value_or(0);
  return {sensor.response_time_s, sensor.robot_from_sensor, options_->occupancy.resolution_m,
          GasOptionsOf(*options_, species)};
}

void Mission::NotePose(const RobotId& robot, std::int64_t time_ns, const Pose2& pose) {
  const auto found = lagging_.find(robot);
  if (found == lagging_.end()) return;
  for (WayReadings& way : found->second) way.NotePose(time_ns, pose);
}

absl::Status Mission::TakeReading(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                                  GasReading reading) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const GasSensor sensor, fleet_.SensorOf(robot, reading.sensor));
  if (reading.variance_ppm2 == 0.0) reading.variance_ppm2 = sensor.stddev_ppm * sensor.stddev_ppm;
  if (sensor.response_time_s == 0.0) return Keep(robot, sensor, {time_ns, pose, reading});
  const auto index = static_cast<std::size_t>(reading.sensor);
  const auto found = lagging_.find(robot);
  const std::size_t known = found == lagging_.end() ? 0 : found->second.size();
  if (index >= known) {
    const auto ways = static_cast<std::int64_t>(index + 1 - known);
    PLUMESCOUT_RETURN_IF_ERROR(CheckRoom(pose.position(), ways * kWayBytes));
  }
  std::vector<WayReadings>& ways = lagging_[robot];
  ways.resize(std::max(known, index + 1));
  return KeepAll(robot, sensor, ways[index].Add(ModelOf(sensor), time_ns, pose, reading));
}

// What is told of one reading. All of it is tried; the error is that of the first that was refused.
absl::Status Mission::KeepAll(const RobotId& robot, const GasSensor& sensor,
                              const std::vector<AirReading>& told) {
  absl::Status kept;
  for (const AirReading& air : told) kept.Update(Keep(robot, sensor, air));
  return kept;
}

// Sensors meet where they read, not in each cell that a reading tells of: the first stands for all.
absl::Status Mission::Keep(const RobotId& robot, const GasSensor& sensor, const AirReading& air) {
  const std::size_t species = FindSpecies(*options_, sensor.species).value_or(0);
  const Point2 place = PlaceOnRobot(air.pose, sensor.robot_from_sensor);
  const bool suspect = fleet_.StateOf(robot).frame_suspect;
  if (!suspect) {
    const ReadingSource source{robot, sensor.id, sensor.offset_stddev_ppm};
    PLUMESCOUT_RETURN_IF_ERROR(
        AddReading(species, source, air.time_ns, place, air.reading, air.is_part));
  }
  history_.AddReading(robot, air.time_ns, air.pose, air.reading, suspect, sensor, species,
                      air.is_part);
  return absl::OkStatus();
}

absl::Status Mission::AddReading(std::size_t species, const ReadingSource& source,
                                 std::int64_t time_ns, Point2 place, const GasReading& reading,
                                 bool is_part) {
  GasMap& gas = gas_[species];
  if (!gas.HasRoomFor(place)) {
    return BudgetReached(absl::StrCat("readings at ", ReadingStore::kMostWaitingSites,
                                      " places wait for their cells to be seen"));
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckRoom(place, kReadingSiteBytes + kReadingBucketBytes));
  if (fleet_.has_offsets() && !is_part) {
    gas.AddFrom(source, time_ns, place, reading);
    gas_changed_since_snapshot_ = true;
  } else {
    gas.Add(time_ns, place, reading, is_part);
  }
  region_.Visit(place);
  const bool is_new = sampled_cells_[species].Add(time_ns, place);
  rasters_.gas[species].sampled_cells = nullptr;
  sampled_since_snapshot_ |= is_new && species == 0;  // for plans
  return absl::OkStatus();
}

// Those that lagging_ has entries of, by their place.
std::vector<GasSensor> Mission::LaggingSensors(const RobotId& robot) const {
  std::vector<GasSensor> sensors;
  const auto found = lagging_.find(robot);
  if (found == lagging_.end()) return sensors;
  for (std::size_t i = 0; i < found->second.size(); ++i) {
    sensors.push_back(fleet_.SensorOf(robot, static_cast<int>(i)).value_or(GasSensor()));
  }
  return sensors;
}

// Where FinishWays would add readings to the robot's way.
std::vector<WayPoint> Mission::UntoldPoints(const RobotId& robot) const {
  std::vector<WayPoint> points;
  const std::vector<GasSensor> sensors = LaggingSensors(robot);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    for (const AirReading& air : lagging_.at(robot)[i].Untold(ModelOf(sensors[i]))) {
      points.push_back({air.time_ns, air.pose});
    }
  }
  return points;
}

// Before the way lies elsewhere, or once the sensors, which were these, are others. What has no
// room is lost, as it would be a moment later.
void Mission::FinishWays(const RobotId& robot, const std::vector<GasSensor>& sensors) {
  const auto found = lagging_.find(robot);
  if (found == lagging_.end()) return;
  std::vector<WayReadings> ways = std::move(found->second);
  lagging_.erase(found);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    KeepAll(robot, sensors[i], ways[i].Finish(ModelOf(sensors[i]))).IgnoreError();
  }
}

}  // namespace plumescout
