// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Robots that lose their place: how many jumps of half a metre and more go unnoticed, how many
// robots are doubted that have not lost it, and how near the gas field of a mission whose robot
// jumped by 2 m and 20 degrees and said so a minute later comes to that of a mission whose robot
// did not. Four robots drive about in buildings in which people walk; all have noise of 0.02 m and
// 0.5 degrees in their poses and 0.02 m in their ranges. The same ways are driven with and without
// jump.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/sim/lidar.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kStep_ns = kSecond_ns / 5;  // five scans a second
constexpr double kStep_m = 0.12;                   // 0.6 m/s
constexpr double kClear_m = 0.4;                   // ahead of a step, to walls
constexpr int kStepsBetweenReadings = 3;
constexpr int kRobots = 4;
constexpr int kPeople = 2;
constexpr int kWidth_cells = 160;
constexpr int kHeight_cells = 200;
constexpr double kPoseNoise_m = 0.02;
constexpr double kPoseNoise_rad = 0.5 * M_PI / 180.0;
constexpr double kRangeNoise_m = 0.02;

// What one robot sensed in one step.
struct Sensed {
  Pose2 truth;
  Pose2 told;
  Scan scan;
  double gas_ppm = 0.0;
};

// Everything that all robots sensed, by step and robot.
struct Journey {
  Grid<std::uint8_t> walls;
  std::vector<std::vector<Sensed>> steps;
};

double Gas_ppm(Point2 place) {
  constexpr Point2 kSource{6.0, 8.0};
  const double dx = place.x_m - kSource.x_m;
  const double dy = place.y_m - kSource.y_m;
  return 20.0 * std::exp(-dx * dx / 18.0 - dy * dy / 8.0);
}

Sensed Sense(const Grid<std::uint8_t>& walls, const Pose2& pose, const std::vector<Body>& bodies,
             Rng& rng) {
  Sensed sensed{pose, pose, ScanBuilding(walls, pose), Gas_ppm(pose.position())};
  sensed.told.x_m += kPoseNoise_m * rng.Gaussian();
  sensed.told.y_m += kPoseNoise_m * rng.Gaussian();
  sensed.told.yaw_rad += kPoseNoise_rad * rng.Gaussian();
  for (std::size_t i = 0; i < sensed.scan.ranges_m.size(); ++i) {
    const double angle_rad = pose.yaw_rad + sensed.scan.start_angle_rad +
                             static_cast<double>(i) * sensed.scan.angle_step_rad;
    const double body_m = CastBeamAtBodies_m(bodies, pose.position(), angle_rad);
    const double range_m = std::min(static_cast<double>(sensed.scan.ranges_m[i]), body_m);
    sensed.scan.ranges_m[i] = static_cast<float>(range_m + kRangeNoise_m * rng.Gaussian());
  }
  return sensed;
}

Journey MakeJourney(std::uint64_t seed, int seconds) {
  Journey journey{MakeBuilding(kWidth_cells, kHeight_cells, seed), {}};
  std::vector<Pose2> poses = FreePoses(journey.walls, kRobots + kPeople, seed);
  Rng rng(seed);
  const auto steps = static_cast<std::size_t>(seconds * kSecond_ns / kStep_ns);
  for (std::size_t step = 0; step < steps; ++step) {
    for (Pose2& pose : poses) DriveOn(journey.walls, kStep_m, kClear_m, rng, pose);
    std::vector<Sensed>& sensed = journey.steps.emplace_back();
    for (std::size_t i = 0; i < kRobots; ++i) {
      std::vector<Body> bodies;
      for (std::size_t k = 0; k < poses.size(); ++k) {
        if (k != i) bodies.push_back({poses[k].position(), 0.2});
      }
      sensed.push_back(Sense(journey.walls, poses[i], bodies, rng));
    }
  }
  return journey;
}

// What befalls robot 0.
struct Jump {
  std::size_t step = 0;
  double east_m = 0.0;
  double north_m = 0.0;
  double turn_rad = 0.0;
  std::optional<std::size_t> corrected_step = std::nullopt;

  Pose2 About(const Pose2& place) const {
    return Compose({place.x_m + east_m, place.y_m + north_m, place.yaw_rad + turn_rad},
                   Inverse(place));
  }
};

// Counts who is doubted.
class Watcher final : public ConductObserver {
 public:
  void OnEvent(const Event& event, const Applied& applied) override {
    if (!applied.turned_suspect) return;
    const auto& received = std::get<ObservationReceived>(event.body);
    (received.robot == "a" ? of_first : of_others).push_back(received.observation.sample_time_ns);
  }
  std::vector<std::int64_t> of_first;
  std::vector<std::int64_t> of_others;
};

struct Outcome {
  Watcher watcher;
  std::unique_ptr<MissionConduct> conduct;
};

PoseCorrection CorrectionOf(const Journey& journey, const Jump& jump) {
  PoseCorrection correction;
  for (const std::size_t step : {jump.step - 1, jump.step, *jump.corrected_step - 1}) {
    correction.anchors.push_back(
        {static_cast<std::int64_t>(step + 1) * kStep_ns, journey.steps[step][0].truth});
  }
  return correction;
}

absl::Status Run(const Journey& journey, const std::optional<Jump>& jump, bool reads,
                 Outcome& outcome) {
  MissionOptions options;
  options.gas.refresh_period_s = 2.0;
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(options));
  outcome.conduct = std::make_unique<MissionConduct>(std::move(mission), &outcome.watcher);
  std::vector<std::int64_t> sequences(kRobots, 0);
  const auto robot = [](std::size_t i) { return std::string(1, static_cast<char>('a' + i)); };
  for (std::size_t i = 0; i < kRobots; ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(
        outcome.conduct->Register(RobotRegistered{robot(i), 0.2, 1}).status());
  }
  for (std::size_t step = 0; step < journey.steps.size(); ++step) {
    const std::int64_t now_ns = static_cast<std::int64_t>(step + 1) * kStep_ns;
    for (std::size_t i = 0; i < kRobots; ++i) {
      const Sensed& sensed = journey.steps[step][i];
      const bool lost = jump && i == 0 && step >= jump->step &&
                        !(jump->corrected_step && step >= *jump->corrected_step);
      const Pose2 told = lost
                             ? Compose(jump->About(journey.steps[jump->step][0].truth), sensed.told)
                             : sensed.told;
      std::vector<IncomingObservation> batch;
      if (jump && i == 0 && jump->corrected_step && step == *jump->corrected_step) {
        batch.emplace_back().observation = {++sequences[i], now_ns - 1, told,
                                            CorrectionOf(journey, *jump)};
      }
      batch.emplace_back().observation = {++sequences[i], now_ns, told, sensed.scan};
      if (reads && step % kStepsBetweenReadings == 0) {
        batch.emplace_back().observation = {++sequences[i], now_ns, told,
                                            GasReading{sensed.gas_ppm, 0.0}};
      }
      const IngestResult result = outcome.conduct->Ingest(robot(i), 1, std::move(batch));
      PLUMESCOUT_RETURN_IF_ERROR(result.status);
      for (const RefusedObservation& refused : result.refused) return refused.status;
    }
  }
  return absl::OkStatus();
}

// Over the cells of the building that are free, as clean air where the map has no estimate.
absl::StatusOr<double> Error_ppm(const Journey& journey, MissionConduct& conduct) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto belief, conduct.FreshBelief());
  double squares = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < journey.walls.size(); ++i) {
    if (journey.walls[i] != 0) continue;
    const Point2 at = journey.walls.geometry().Center(journey.walls.geometry().CellAtIndex(i));
    const float mean_ppm = belief->gas_mean_ppm->At(belief->geometry().CellAt(at), 0.0F);
    const double error_ppm =
        (std::isnan(mean_ppm) ? 0.0 : static_cast<double>(mean_ppm)) - Gas_ppm(at);
    squares += error_ppm * error_ppm;
    cells += 1.0;
  }
  return std::sqrt(squares / cells);
}

constexpr std::size_t StepAt(int seconds) {
  return static_cast<std::size_t>(seconds * kSecond_ns / kStep_ns);
}

absl::Status MeasureJumps(int buildings, BenchSummary& summary) {
  constexpr double kLengths_m[] = {0.5, 0.6, 0.8, 1.2, 2.0};
  constexpr int kSeconds = 100;
  int jumps = 0;
  int undetected = 0;
  int false_alarms = 0;
  std::vector<double> delays_s;
  Rng rng(summary.seed());
  for (int b = 0; b < buildings; ++b) {
    const Journey journey = MakeJourney(summary.seed() + static_cast<std::uint64_t>(b), kSeconds);
    Outcome ordinary;
    PLUMESCOUT_RETURN_IF_ERROR(Run(journey, std::nullopt, false, ordinary));
    false_alarms +=
        static_cast<int>(ordinary.watcher.of_first.size() + ordinary.watcher.of_others.size());
    for (const double length_m : kLengths_m) {
      const double direction_rad = rng.Uniform(-M_PI, M_PI);
      const double turn_rad = jumps % 2 == 0 ? 0.0 : rng.Uniform(-0.35, 0.35);
      const Jump jump{StepAt(40 + 5 * (jumps % 5)), length_m * std::cos(direction_rad),
                      length_m * std::sin(direction_rad), turn_rad};
      Outcome outcome;
      PLUMESCOUT_RETURN_IF_ERROR(Run(journey, jump, false, outcome));
      ++jumps;
      const double jumped_s = 1e-9 * static_cast<double>(kStep_ns) * static_cast<double>(jump.step);
      double first_s = INFINITY;
      for (const std::int64_t time_ns : outcome.watcher.of_first) {
        const double delay_s = 1e-9 * static_cast<double>(time_ns) - jumped_s;
        if (delay_s >= 0.0) first_s = std::min(first_s, delay_s);
      }
      if (std::isinf(first_s)) {
        ++undetected;
      } else {
        delays_s.push_back(first_s);
      }
      false_alarms += static_cast<int>(outcome.watcher.of_others.size());
    }
  }
  std::sort(delays_s.begin(), delays_s.end());
  summary.Set("jumps", jumps);
  summary.Set("undetected", undetected);
  summary.Set("false_alarms", false_alarms);
  if (delays_s.empty()) return absl::OkStatus();
  summary.Set("detected_after_median_s", delays_s[delays_s.size() / 2]);
  summary.Set("detected_after_worst_s", delays_s.back());
  return absl::OkStatus();
}

absl::Status MeasureCorrections(int buildings, BenchSummary& summary) {
  constexpr int kSeconds = 180;
  double worst_ratio = 0.0;
  double sum_ratio = 0.0;
  for (int b = 0; b < buildings; ++b) {
    const Journey journey =
        MakeJourney(summary.seed() + 100 + static_cast<std::uint64_t>(b), kSeconds);
    Rng rng(summary.seed() + static_cast<std::uint64_t>(b));
    const double direction_rad = rng.Uniform(-M_PI, M_PI);
    const Jump jump{StepAt(60), 2.0 * std::cos(direction_rad), 2.0 * std::sin(direction_rad),
                    20.0 * M_PI / 180.0, StepAt(120)};
    Outcome without;
    PLUMESCOUT_RETURN_IF_ERROR(Run(journey, std::nullopt, true, without));
    Outcome with;
    PLUMESCOUT_RETURN_IF_ERROR(Run(journey, jump, true, with));
    PLUMESCOUT_ASSIGN_OR_RETURN(const double right_ppm, Error_ppm(journey, *without.conduct));
    PLUMESCOUT_ASSIGN_OR_RETURN(const double mended_ppm, Error_ppm(journey, *with.conduct));
    worst_ratio = std::max(worst_ratio, mended_ppm / right_ppm);
    sum_ratio += mended_ppm / right_ppm;
    summary.Set(absl::StrCat("building_", b, "_error_without_jump_ppm"), right_ppm);
    summary.Set(absl::StrCat("building_", b, "_error_corrected_ppm"), mended_ppm);
  }
  summary.Set("corrected_error_ratio_worst", worst_ratio);
  summary.Set("corrected_error_ratio_mean", sum_ratio / buildings);
  return absl::OkStatus();
}

absl::Status MeasureAll(int jump_buildings, int corrected_buildings, BenchSummary& summary) {
  PLUMESCOUT_RETURN_IF_ERROR(MeasureJumps(jump_buildings, summary));
  return MeasureCorrections(corrected_buildings, summary);
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  int buildings = 10;
  return plumescout::lab::BenchProgram(
             "Robots that lose their place: jumps that go unnoticed, and what corrections mend")
      .AddCount("--buildings", buildings, "Five jumps, and one that is corrected, in each")
      .Run(argc, argv, [&](plumescout::lab::BenchSummary& summary) {
        return plumescout::lab::MeasureAll(buildings, buildings, summary);
      });
}
