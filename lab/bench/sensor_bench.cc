// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Gas sensors with unknown offsets: how near the field comes to that of calibrated sensors where
// robots' ways cross, and that it is no worse where they do not. Four robots drive about in known
// buildings for five minutes, all over the building or each in a quarter of its own; the first is
// calibrated. The same ways and noise are used for every row.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kRobots = 4;
constexpr int kWidth_cells = 160;
constexpr int kHeight_cells = 200;
constexpr int kReadings = 600;  // of each robot, two a second
constexpr std::int64_t kPeriod_ns = 500'000'000;
constexpr double kStep_m = 0.3;   // between readings
constexpr double kClear_m = 0.2;  // ahead of a step, to walls
constexpr double kNoise_ppm = 0.3;
constexpr double kBackground_ppm = 10.0;  // above what offsets take off

double Gas_ppm(Point2 place) {
  const auto plume = [place](Point2 source, double ppm, double along_m, double across_m) {
    const double dx = (place.x_m - source.x_m) / along_m;
    const double dy = (place.y_m - source.y_m) / across_m;
    return ppm * std::exp(-dx * dx - dy * dy);
  };
  return kBackground_ppm + plume({6.0, 8.0}, 20.0, 4.2, 2.8) + plume({12.0, 15.0}, 8.0, 3.0, 4.0);
}

// What keeps each robot in its quarter: strips that are wider than readings count as near.
Grid<std::uint8_t> Quartered(Grid<std::uint8_t> walls) {
  constexpr int kHalfStrip_cells = 7;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Cell cell = walls.geometry().CellAtIndex(i);
    if (std::abs(cell.x - kWidth_cells / 2) < kHalfStrip_cells ||
        std::abs(cell.y - kHeight_cells / 2) < kHalfStrip_cells) {
      walls[i] = 1;
    }
  }
  return walls;
}

bool IsFree(const Grid<std::uint8_t>& walls, Point2 place) {
  return walls.At(walls.geometry().CellAt(place), 1) == 0;
}

// Where robot `robot` begins: one of many free places, in its quarter of the building.
Pose2 StartOf(const Grid<std::uint8_t>& walls, int robot, std::uint64_t seed) {
  constexpr int kPlaces = 500;
  for (const Pose2& pose : FreePoses(walls, kPlaces, seed)) {
    const Cell cell = walls.geometry().CellAt(pose.position());
    const bool east = cell.x >= kWidth_cells / 2;
    const bool north = cell.y >= kHeight_cells / 2;
    if (east == (robot % 2 == 1) && north == (robot / 2 == 1)) return pose;
  }
  return {};
}

// A reading as a sensor without offset would have it.
struct Reading {
  Pose2 pose;
  double ppm = 0.0;
};

struct Case {
  Grid<std::uint8_t> walls;
  std::vector<std::vector<Reading>> readings;  // by robot
  std::vector<double> unit_offsets;            // standard normal; 0 of the first robot
};

Case MakeCase(std::uint64_t seed, bool cross) {
  Case c;
  c.walls = MakeBuilding(kWidth_cells, kHeight_cells, seed);
  const Grid<std::uint8_t> driven = cross ? c.walls : Quartered(c.walls);
  Rng rng(seed);
  for (int robot = 0; robot < kRobots; ++robot) {
    c.unit_offsets.push_back(robot == 0 ? 0.0 : rng.Gaussian());
    Pose2 pose = StartOf(driven, robot, seed);
    std::vector<Reading>& readings = c.readings.emplace_back();
    for (int i = 0; i < kReadings; ++i) {
      DriveOn(driven, kStep_m, kClear_m, rng, pose);
      readings.push_back({pose, Gas_ppm(pose.position()) + kNoise_ppm * rng.Gaussian()});
    }
  }
  return c;
}

enum class Sensors { kCalibrated, kIgnored, kEstimated };

struct Outcome {
  double error_ppm = 0.0;  // root mean square over free cells
  std::vector<SensorOffset> offsets;
};

MissionOptions OptionsFor(const Case& c) {
  MissionOptions options;
  options.gas.background_mean_ppm = kBackground_ppm;
  options.gas.refresh_period_s = 30.0;
  auto map = std::make_shared<Grid<CellState>>(c.walls.geometry(), CellState::kFree);
  for (std::size_t i = 0; i < map->size(); ++i) {
    if (c.walls[i] != 0) (*map)[i] = CellState::kOccupied;
  }
  options.prior_map = std::move(map);
  return options;
}

absl::StatusOr<Outcome> Run(const Case& c, double offset_stddev_ppm, Sensors sensors) {
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(OptionsFor(c)));
  MissionConduct conduct(std::move(mission));
  const auto name = [](int robot) { return std::string(1, static_cast<char>('a' + robot)); };
  constexpr double kDataSheet_ppm = 1.0;
  for (int robot = 0; robot < kRobots; ++robot) {
    const bool unsure = sensors == Sensors::kEstimated && robot > 0;
    RobotRegistered registered{name(robot), 0.2, 1};
    registered.sensors = {{"pid", {}, kNoise_ppm, unsure ? kDataSheet_ppm : 0.0}};
    PLUMESCOUT_RETURN_IF_ERROR(conduct.Register(registered).status());
  }
  for (int i = 0; i < kReadings; ++i) {
    for (int robot = 0; robot < kRobots; ++robot) {
      const auto at = static_cast<std::size_t>(robot);
      const Reading& reading = c.readings[at][static_cast<std::size_t>(i)];
      const double offset_ppm =
          sensors == Sensors::kCalibrated ? 0.0 : offset_stddev_ppm * c.unit_offsets[at];
      std::vector<IncomingObservation> batch(1);
      batch[0].observation = {i + 1, (i + 1) * kPeriod_ns, reading.pose,
                              GasReading{std::max(0.0, reading.ppm + offset_ppm), 0.0}};
      const IngestResult result = conduct.Ingest(name(robot), 1, std::move(batch));
      PLUMESCOUT_RETURN_IF_ERROR(result.status);
      for (const RefusedObservation& refused : result.refused) return refused.status;
    }
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto belief, conduct.FreshBelief());
  double squares = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < belief->gas_mean_ppm->size(); ++i) {
    const float mean_ppm = (*belief->gas_mean_ppm)[i];
    const Point2 place = belief->geometry().Center(belief->geometry().CellAtIndex(i));
    if (std::isnan(mean_ppm) || !IsFree(c.walls, place)) continue;
    const double error_ppm = mean_ppm - Gas_ppm(place);
    squares += error_ppm * error_ppm;
    cells += 1.0;
  }
  return Outcome{std::sqrt(squares / cells), belief->sensor_offsets};
}

// Means over the buildings of each row's error, and how far off offsets are by their own measure.
absl::Status Measure(int buildings, bool cross, double stddev_ppm, BenchSummary& summary) {
  double calibrated_ppm = 0.0;
  double ignored_ppm = 0.0;
  double estimated_ppm = 0.0;
  double worst_ratio = 0.0;  // of a building
  double squared_scores = 0.0;
  int estimated = 0;
  for (int b = 0; b < buildings; ++b) {
    const Case c = MakeCase(summary.seed() + static_cast<std::uint64_t>(b), cross);
    PLUMESCOUT_ASSIGN_OR_RETURN(const Outcome right, Run(c, stddev_ppm, Sensors::kCalibrated));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Outcome wrong, Run(c, stddev_ppm, Sensors::kIgnored));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Outcome mended, Run(c, stddev_ppm, Sensors::kEstimated));
    calibrated_ppm += right.error_ppm / buildings;
    ignored_ppm += wrong.error_ppm / buildings;
    estimated_ppm += mended.error_ppm / buildings;
    const double rival_ppm = cross ? right.error_ppm : wrong.error_ppm;
    worst_ratio = std::max(worst_ratio, mended.error_ppm / rival_ppm);
    for (const SensorOffset& offset : mended.offsets) {
      if (!offset.estimated) continue;
      const auto robot = static_cast<std::size_t>(offset.robot[0] - 'a');
      const double off_ppm = offset.offset_ppm - stddev_ppm * c.unit_offsets[robot];
      squared_scores += off_ppm * off_ppm / (offset.stddev_ppm * offset.stddev_ppm);
      ++estimated;
    }
  }
  const std::string prefix = absl::StrCat(cross ? "crossing" : "apart", "_", stddev_ppm, "ppm_");
  summary.Set(prefix + "calibrated_error_ppm", calibrated_ppm);
  summary.Set(prefix + "ignored_error_ppm", ignored_ppm);
  summary.Set(prefix + "estimated_error_ppm", estimated_ppm);
  summary.Set(prefix + (cross ? "to_calibrated_worst_ratio" : "to_ignored_worst_ratio"),
              worst_ratio);
  summary.Set(prefix + "estimated_sensors", estimated);
  if (estimated > 0)
    summary.Set(prefix + "offset_rms_score", std::sqrt(squared_scores / estimated));
  return absl::OkStatus();
}

absl::Status MeasureAll(int buildings, BenchSummary& summary) {
  for (const bool cross : {true, false}) {
    for (const double stddev_ppm : {0.0, 1.0, 2.0}) {
      PLUMESCOUT_RETURN_IF_ERROR(Measure(buildings, cross, stddev_ppm, summary));
    }
  }
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  int buildings = 6;
  return plumescout::lab::BenchProgram("Gas sensors with unknown offsets, beside calibrated ones")
      .AddCount("--buildings", buildings, "Of 16 m x 20 m")
      .Run(argc, argv, [&](plumescout::lab::BenchSummary& summary) {
        return plumescout::lab::MeasureAll(buildings, summary);
      });
}
