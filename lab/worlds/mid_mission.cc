// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/mid_mission.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "core/occupancy/free_space.h"
#include "core/plan/strategy.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "core/types/trajectory.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kLease = 1;
constexpr int kTicksPerRound = 10;
constexpr std::int64_t kTick_ns = 400'000'000;
constexpr double kTick_s = 0.4;
constexpr int kTicksPerScan = 2;
constexpr double kRobotRadius_m = 0.2;

std::shared_ptr<const Grid<CellState>> SouthOf(const Grid<std::uint8_t>& walls) {
  auto known = std::make_shared<Grid<CellState>>(walls.geometry(), CellState::kUnknown);
  const std::size_t half = walls.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    (*known)[i] = walls[i] != 0 ? CellState::kOccupied : CellState::kFree;
  }
  return known;
}

class Plumes {
 public:
  Plumes(const GridGeometry& geometry, Rng& rng) {
    constexpr int kPlumes = 3;
    for (int i = 0; i < kPlumes; ++i) {
      sources_.push_back(geometry.Center(geometry.CellAtIndex(rng.Below(geometry.size()))));
    }
  }

  double At_ppm(Point2 place) const {
    constexpr double kPeak_ppm = 40.0;
    constexpr double kWidth_m = 3.0;
    double sum_ppm = 0.0;
    for (const Point2 source : sources_) {
      const double distance = Distance_m(source, place) / kWidth_m;
      sum_ppm += kPeak_ppm * std::exp(-distance * distance);
    }
    return sum_ppm;
  }

 private:
  std::vector<Point2> sources_;
};

struct Driver {
  RobotId id;
  Pose2 pose;
  std::int64_t sequence = 0;
};

class MidMission {
 public:
  MidMission(const MidMissionOptions& options, std::unique_ptr<Mission> mission,
             std::unique_ptr<const Strategy> strategy, Grid<std::uint8_t> walls)
      : options_(options),
        walls_(std::move(walls)),
        rng_(options.seed),
        plumes_(walls_.geometry(), rng_),
        conduct_(std::move(mission)),
        strategy_(std::move(strategy)) {}

  absl::StatusOr<std::vector<PlanMoment>> Run() {
    const Grid<std::uint8_t> traversable =
        TraversableCells(*conduct_.mission().options().prior_map,
                         conduct_.mission().options().occupancy.inflation_radius_m);
    for (int i = 0; i < options_.robots; ++i) {
      PLUMESCOUT_RETURN_IF_ERROR(Join(std::string(1, static_cast<char>('a' + i)), traversable));
    }
    for (int round = 0; round < options_.rounds; ++round) {
      if (2 * round == options_.rounds) moments_.clear();
      std::vector<Trajectory> ways;
      for (const Driver& driver : drivers_) {
        PLUMESCOUT_ASSIGN_OR_RETURN(Trajectory way, PlanFor(driver));
        ways.push_back(std::move(way));
      }
      for (int tick = 1; tick <= kTicksPerRound; ++tick) {
        now_ns_ += kTick_ns;
        for (std::size_t i = 0; i < drivers_.size(); ++i) {
          if (!ways[i].waypoints.empty()) drivers_[i].pose = PoseAt(ways[i], tick * kTick_s);
          PLUMESCOUT_RETURN_IF_ERROR(Observe(drivers_[i], tick % kTicksPerScan == 0));
        }
      }
    }
    return std::move(moments_);
  }

 private:
  absl::Status Join(RobotId id, const Grid<std::uint8_t>& traversable) {
    PLUMESCOUT_RETURN_IF_ERROR(
        conduct_.Register(RobotRegistered{id, kRobotRadius_m, kLease, kLease}).status());
    std::size_t index = 0;
    do {
      index = rng_.Below(traversable.size());
    } while (traversable[index] == 0);
    const Point2 place = traversable.geometry().Center(traversable.geometry().CellAtIndex(index));
    drivers_.push_back({std::move(id), {place.x_m, place.y_m, 0.0}});
    return Observe(drivers_.back(), /*scans=*/true);
  }

  absl::Status Observe(Driver& driver, bool scans) {
    std::vector<IncomingObservation> batch;
    if (scans) {
      batch.emplace_back().observation = {++driver.sequence, now_ns_, driver.pose,
                                          ScanBuilding(walls_, driver.pose)};
    }
    batch.emplace_back().observation = {++driver.sequence, now_ns_, driver.pose,
                                        GasReading{plumes_.At_ppm(driver.pose.position()), 0.0}};
    return conduct_.Ingest(driver.id, kLease, std::move(batch)).status;
  }

  // Empty if the robot is to stay, or another is in its way.
  absl::StatusOr<Trajectory> PlanFor(const Driver& driver) {
    PLUMESCOUT_ASSIGN_OR_RETURN(auto belief, conduct_.FreshBelief());
    PlanRequest request;
    request.robot = driver.id;
    moments_.push_back({belief, driver.id});
    PLUMESCOUT_ASSIGN_OR_RETURN(const Plan plan, strategy_->Plan(*belief, request, NeverStop()));
    return conduct_.Commit(plan, kLease).ok() ? plan.trajectory : Trajectory{};
  }

  const MidMissionOptions options_;
  const Grid<std::uint8_t> walls_;
  Rng rng_;
  const Plumes plumes_;
  MissionConduct conduct_;
  const std::unique_ptr<const Strategy> strategy_;
  std::vector<Driver> drivers_;
  std::int64_t now_ns_ = kTick_ns;
  std::vector<PlanMoment> moments_;
};

}  // namespace

absl::StatusOr<std::vector<PlanMoment>> RunToMidMission(const MidMissionOptions& options) {
  Grid<std::uint8_t> walls = MakeBuilding(options.width_cells, options.height_cells, options.seed);
  MissionOptions mission_options;
  const auto cells = static_cast<std::int64_t>(walls.size());
  const double extent_m = walls.geometry().resolution_m * (walls.width() + walls.height());
  mission_options.occupancy.max_cell_count =
      std::max(mission_options.occupancy.max_cell_count, 2 * cells);
  mission_options.occupancy.max_extent_m =
      std::max(mission_options.occupancy.max_extent_m, extent_m);
  mission_options.prior_map = SouthOf(walls);
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(mission_options));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto strategy, MakeStrategy(mission_options.planning));
  return MidMission(options, std::move(mission), std::move(strategy), std::move(walls)).Run();
}

}  // namespace plumescout::lab
