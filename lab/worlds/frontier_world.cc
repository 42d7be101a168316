// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/frontier_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/frontier/gas_frontier.h"
#include "core/mission/mission.h"
#include "core/plan/strategy.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/sim/lidar.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {
namespace {

constexpr double kResolution_m = 0.25;
constexpr int kSteps = 3;
constexpr char kRobot[] = "robot-1";

// North up: '#' occupied, '.' free, 'S' the leak, 'v' a vent.
// clang-format off
constexpr const char* kPlan[] = {
    "#########################",
    "#..........###..........#",
    "#..........###..........#",
    "#..........###....S.....#",
    "#..........###..........#",
    "#.....vvv..###..........#",
    "######...######...#######",
    "######...######...#######",
    "######...######...#######",
    "#v................#######",
    "#v................#######",
    "#v................#######",
    "#########################",
};
// clang-format on
constexpr int kHeight = static_cast<int>(std::size(kPlan));

// Steady diffusion: what leaves the leak reaches a vent. `held` is NaN where the gas is to be found
// and elsewhere what it is held at, by relaxation.
Grid<float> Diffuse(const Grid<CellState>& occupancy, const Grid<float>& held_ppm) {
  constexpr int kSweeps = 5000;  // more change nothing that can be seen
  Grid<float> gas_ppm(occupancy.geometry(), 0.0F);
  for (std::size_t i = 0; i < gas_ppm.size(); ++i) {
    if (!std::isnan(held_ppm[i])) gas_ppm[i] = held_ppm[i];
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < gas_ppm.size(); ++i) {
      if (occupancy[i] != CellState::kFree || !std::isnan(held_ppm[i])) continue;
      const Cell cell = gas_ppm.geometry().CellAtIndex(i);
      float sum_ppm = 0.0F;
      int neighbours = 0;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const Cell next{cell.x + dx, cell.y + dy};
        if (occupancy.At(next, CellState::kOccupied) != CellState::kFree) continue;
        sum_ppm += gas_ppm[next];
        ++neighbours;
      }
      gas_ppm[i] = sum_ppm / static_cast<float>(neighbours);
    }
  }
  return gas_ppm;
}

MissionOptions MakeOptions(WgfdScope scope, std::uint64_t seed) {
  MissionOptions options;
  options.occupancy = PublishedOccupancyOptions();  // a figure of [XIT]
  options.gas = PublishedGasOptions();
  options.occupancy.resolution_m = kResolution_m;
  options.frontier.wgfd_scope = scope;
  options.frontier.min_gas_cell_count = 3;     // the width of a corridor
  options.planning.min_goal_distance_m = 0.2;  // less than a cell
  options.planning.max_goal_count = 1;  // leaves no slot for occupancy frontiers while there is gas
  options.seed = seed;
  return options;
}

// A robot in the world, with its mission.
class Walker {
 public:
  Walker(const FrontierWorld& world, std::unique_ptr<Mission> mission,
         std::unique_ptr<const Strategy> strategy, std::uint64_t seed)
      : world_(world),
        mission_(std::move(mission)),
        strategy_(std::move(strategy)),
        lidar_(LidarOptions{.noise_sigma_m = 0.0}, seed),
        noise_(seed) {}

  absl::StatusOr<FrontierWalk> Run() {
    PLUMESCOUT_RETURN_IF_ERROR(mission_->Apply(RobotRegistered{kRobot, 0.2, 1}).status());
    PLUMESCOUT_RETURN_IF_ERROR(Follow(world_.entry));
    for (int i = 0; i < kSteps; ++i) {
      PLUMESCOUT_ASSIGN_OR_RETURN(FrontierStep step, PlanNext());
      walk_.steps.push_back(step);
      if (i + 1 == kSteps || step.plan.chosen < 0) break;
      const auto chosen = static_cast<std::size_t>(step.plan.chosen);
      PLUMESCOUT_RETURN_IF_ERROR(Follow(step.plan.candidates[chosen].path));
      PLUMESCOUT_RETURN_IF_ERROR(
          mission_->Apply(ProgressReported{kRobot, step.plan.id, ProgressOutcome::kReached})
              .status());
    }
    return std::move(walk_);
  }

 private:
  absl::StatusOr<FrontierStep> PlanNext() {
    FrontierStep step;
    step.belief = mission_->Snapshot();
    step.map = MakeMapSnapshot(*step.belief);
    step.robot = pose_;
    step.driven = driven_;
    PlanRequest request;
    request.robot = kRobot;
    PLUMESCOUT_ASSIGN_OR_RETURN(step.plan, strategy_->Plan(*step.belief, request, NeverStop()));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, mission_->Apply(PlanIssued{step.plan}));
    step.plan.id = applied.plan_id;
    return step;
  }

  // A scan and a reading at every cell's length of the way.
  absl::Status Follow(const std::vector<Point2>& way) {
    for (const Point2 at : PointsAlong(way, kResolution_m)) {
      const bool stands = !driven_.empty() && driven_.back() == at;
      if (stands) continue;
      PLUMESCOUT_RETURN_IF_ERROR(Sense(at));
    }
    return absl::OkStatus();
  }

  absl::Status Sense(Point2 at) {
    constexpr std::int64_t kTick_ns = 200'000'000;  // a cell's length at 1.25 m/s
    constexpr double kNoise_ppm = 0.1;              // of the sensor, as in simulated robots
    constexpr double kNoiseShare = 0.01;
    if (!driven_.empty()) driven_m_ += Distance_m(driven_.back(), at);
    driven_.push_back(at);
    pose_ = {at.x_m, at.y_m, 0.0};
    time_ns_ += kTick_ns;
    const double true_ppm =
        static_cast<double>(world_.gas_ppm.At(world_.gas_ppm.geometry().CellAt(at), 0.0F));
    const double sigma_ppm = std::hypot(kNoise_ppm, kNoiseShare * true_ppm);
    const double reading_ppm = std::max(0.0, true_ppm + sigma_ppm * noise_.Gaussian());
    PLUMESCOUT_RETURN_IF_ERROR(Observe(lidar_.Take(world_.occupancy, pose_)));
    PLUMESCOUT_RETURN_IF_ERROR(Observe(GasReading{reading_ppm, 0.0}));
    PLUMESCOUT_RETURN_IF_ERROR(
        mission_->Apply(PosteriorRefreshed{mission_->sample_time_ns()}).status());
    Note(reading_ppm);
    return absl::OkStatus();
  }

  template <typename Payload>
  absl::Status Observe(Payload payload) {
    return mission_
        ->Apply(ObservationReceived{kRobot, {++sequence_, time_ns_, pose_, std::move(payload)}})
        .status();
  }

  void Note(double reading_ppm) {
    FrontierStep now;
    now.belief = mission_->Snapshot();
    now.map = MakeMapSnapshot(*now.belief);
    FrontierReading note;
    note.step = static_cast<int>(walk_.steps.size());
    note.position = pose_.position();
    note.driven_m = driven_m_;
    note.reading_ppm = reading_ppm;
    note.threshold_ppm = now.map.gas_threshold_ppm;
    const Grid<GasMark> cells = ClassifyGas(now);
    for (const GasMark cell : cells.values()) {
      note.critical_cells += cell == GasMark::kCritical ? 1 : 0;
      note.observed_cells += cell == GasMark::kCritical || cell == GasMark::kObserved ? 1 : 0;
    }
    for (const Frontier* frontier : GasFrontiers(now.map)) {
      ++note.frontiers;
      note.frontier_cells += static_cast<int>(frontier->cells.size());
    }
    walk_.readings.push_back(note);
  }

  const FrontierWorld& world_;
  std::unique_ptr<Mission> mission_;
  std::unique_ptr<const Strategy> strategy_;
  Lidar lidar_;
  Rng noise_;
  Pose2 pose_;
  std::vector<Point2> driven_;
  double driven_m_ = 0.0;
  std::int64_t time_ns_ = 0;
  std::int64_t sequence_ = 0;
  FrontierWalk walk_;
};

}  // namespace

FrontierWorld MakeFrontierWorld() {
  constexpr float kLeak_ppm = 20.5F;
  const int width = static_cast<int>(std::string_view(kPlan[0]).size());
  const GridGeometry geometry{0.0, 0.0, kResolution_m, width, kHeight};
  FrontierWorld world;
  world.occupancy = Grid<CellState>(geometry, CellState::kFree);
  Grid<float> held_ppm(geometry, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < kHeight; ++y) {
    const std::string_view row(kPlan[kHeight - 1 - y]);
    for (int x = 0; x < width; ++x) {
      const char mark = row[static_cast<std::size_t>(x)];
      const Cell cell{x, y};
      if (mark == '#') world.occupancy[cell] = CellState::kOccupied;
      if (mark == 'v') held_ppm[cell] = 0.0F;
      if (mark != 'S') continue;
      held_ppm[cell] = kLeak_ppm;
      world.source = geometry.Center(cell);
    }
  }
  world.gas_ppm = Diffuse(world.occupancy, held_ppm);
  // From clean air into the gas, to the mouth of the northern arm.
  world.entry = {geometry.Center({1, 2}), geometry.Center({7, 2}), geometry.Center({7, 4})};
  return world;
}

absl::StatusOr<FrontierWalk> WalkFrontiers(const FrontierWorld& world, WgfdScope scope,
                                           std::uint64_t seed) {
  MissionOptions options = MakeOptions(scope, seed);
  options.planning.strategy = "xit_gff";
  PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(options.planning));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<Mission> mission, Mission::Create(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<const Strategy> strategy,
                              MakeStrategy(options.planning));
  return Walker(world, std::move(mission), std::move(strategy), seed).Run();
}

std::vector<const Frontier*> GasFrontiers(const MapSnapshot& map) {
  std::vector<const Frontier*> frontiers;
  for (const Frontier& frontier : map.frontiers) {
    const bool counts =
        frontier.kind == FrontierKind::kGas && !frontier.too_small && frontier.reachable;
    if (counts) frontiers.push_back(&frontier);
  }
  return frontiers;
}

Grid<GasMark> ClassifyGas(const FrontierStep& step) {
  const MissionOptions& options = *step.belief->options;
  const double observed_ppm2 = ObservedVariance_ppm2(options.frontier, options.gas);
  Grid<GasMark> cells(step.map.occupancy.geometry(), GasMark::kUnknown);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (step.map.occupancy[i] == CellState::kOccupied) cells[i] = GasMark::kWall;
    if (step.map.occupancy[i] != CellState::kFree) continue;
    const bool observed = static_cast<double>(step.map.gas_variance_ppm2[i]) <= observed_ppm2;
    const bool critical =
        observed && static_cast<double>(step.map.gas_mean_ppm[i]) >= step.map.gas_threshold_ppm;
    cells[i] = critical ? GasMark::kCritical : observed ? GasMark::kObserved : GasMark::kUnobserved;
  }
  return cells;
}

}  // namespace plumescout::lab
