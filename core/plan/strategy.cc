// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/strategy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/grid/escape.h"
#include "core/grid/flood.h"
#include "core/plan/edge_cost.h"
#include "core/plan/explanation.h"
#include "core/plan/goals/goal_set.h"
#include "core/plan/information_field.h"
#include "core/plan/paths/grid_guard.h"
#include "core/plan/paths/shortcut.h"
#include "core/plan/paths/xit.h"
#include "core/plan/selection/candidate_terms.h"
#include "core/plan/selection/selection.h"
#include "core/plan/trajectory_timing.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// What a name of the strategy table stands for.
struct StrategyRow {
  absl::string_view name;
  GoalPolicy goals;
};

constexpr std::array<StrategyRow, 3> kRows = {{{"xit_gff", GoalPolicy::kGasFirst},
                                               {"xit_fgf", GoalPolicy::kOccupancyFirst},
                                               {"xit_f", GoalPolicy::kOccupancyOnly}}};

absl::StatusOr<StrategyRow> FindRow(const std::string& name) {
  const auto* row =
      std::find_if(kRows.begin(), kRows.end(), [&](const auto& r) { return r.name == name; });
  if (row != kRows.end()) return *row;
  return absl::InvalidArgumentError(absl::StrCat(
      "planning.strategy = \"", name, "\" must be one of ", absl::StrJoin(StrategyNames(), ", ")));
}

// Draws of goals and of samples must not follow each other's numbers.
constexpr std::uint64_t kGoalStream = 0x676F616C73ULL;

// The seed of a plan that names none: another for every robot and plan of the mission. FNV-1a over
// the robot's name, stirred by the generator. Never 0.
std::uint64_t DerivedSeed(const Belief& belief, const RobotRecord& robot) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : robot.state.id) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  }
  Rng rng(belief.options->seed ^ Rng(hash).Next());
  const auto plan = static_cast<std::uint64_t>(robot.plans_issued);
  return std::max<std::uint64_t>(Rng(rng.Next() + plan).Next(), 1);
}

absl::StatusOr<Pose2> StartPose(const Belief& belief, const PlanRequest& request,
                                const RobotState& robot) {
  if (!request.start && !robot.has_pose) {
    return absl::FailedPreconditionError(
        absl::StrCat("robot \"", request.robot, "\" has no pose yet"));
  }
  const Pose2 pose = request.start.value_or(robot.pose);
  const bool finite =
      std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad);
  if (!finite || !belief.occupancy->Contains(belief.geometry().CellAt(pose.position()))) {
    return absl::InvalidArgumentError(absl::StrCat("start = (", pose.x_m, ", ", pose.y_m, ", ",
                                                   pose.yaw_rad,
                                                   ") must be finite and inside the map"));
  }
  return pose;
}

// Where the search for paths begins.
struct Departure {
  std::vector<Point2> way_out;  // from the robot to before `start`; empty if it may drive already
  Point2 start;                 // in a traversable cell
};

// None if the robot is walled in by cells that are not traversable.
std::optional<Departure> Depart(const Belief& belief, Point2 robot) {
  const Cell cell = belief.geometry().CellAt(robot);
  const std::vector<Cell> cells = EscapePath(*belief.occupancy, *belief.traversable, cell);
  if (cells.empty()) return std::nullopt;
  if (cells.size() == 1) return Departure{{}, robot};
  std::vector<Point2> way_out = {robot};
  for (const Cell c : cells) way_out.push_back(belief.geometry().Center(c));
  way_out = WithoutCollinear(way_out);
  const Point2 start = way_out.back();
  way_out.pop_back();
  return Departure{std::move(way_out), start};
}

// The common way out of the inflated zone comes first. It counts as length; its cells have no
// information penalty, and no choice depends on it.
void PutBefore(const std::vector<Point2>& way_out, Candidate& candidate) {
  candidate.path.insert(candidate.path.begin(), way_out.begin(), way_out.end());
  for (std::size_t i = 0; i < way_out.size(); ++i) {
    candidate.length_m += Distance_m(candidate.path[i], candidate.path[i + 1]);
  }
}

MissionPhase PhaseOf(GoalKind kind) {
  switch (kind) {
    case GoalKind::kGasFrontier:
      return MissionPhase::kGasProbing;
    case GoalKind::kOccupancyFrontier:
      return MissionPhase::kExploring;
    case GoalKind::kRandomFreeSpace:
      break;
  }
  return MissionPhase::kFallback;
}

absl::Status Stopped() {
  return absl::DeadlineExceededError("planning was stopped before any path was found");
}

// Goals, paths and selection put together.
class ComposedStrategy : public Strategy {
 public:
  explicit ComposedStrategy(const PlanningOptions& options)
      : options_(options), paths_(std::make_unique<XitPlanner>(options)) {}

  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop) const override;

 private:
  // Everything from a place to start to the candidates and the choice. The error is
  // kDeadlineExceeded.
  absl::Status PlanFrom(const Departure& departure, const Belief& belief,
                        const PlanRequest& request, const StopFn& stop,
                        plumescout::Plan& plan) const;
  PathResult FindPaths(const PathProblem& problem) const;
  // Turns what the search found for `goals` into candidates and rejections.
  void TakeResults(const std::vector<Goal>& goals, const PathResult& result,
                   const CandidateJudge& judge, plumescout::Plan& plan) const;

  PlanningOptions options_;
  std::unique_ptr<const PathPlanner> paths_;
};

absl::StatusOr<plumescout::Plan> ComposedStrategy::Plan(const Belief& belief,
                                                        const PlanRequest& request,
                                                        const StopFn& stop) const {
  const auto robot = belief.robots.find(request.robot);
  if (robot == belief.robots.end()) {
    return absl::NotFoundError(absl::StrCat("robot \"", request.robot, "\" is not registered"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const Pose2 pose, StartPose(belief, request, robot->second.state));
  plumescout::Plan plan;
  plan.robot = request.robot;
  plan.strategy = options_.strategy;
  plan.belief_revision = belief.revision;
  plan.seed = request.seed != 0 ? request.seed : DerivedSeed(belief, robot->second);
  plan.phase = MissionPhase::kFallback;
  if (const std::optional<Departure> departure = Depart(belief, pose.position())) {
    plan.start_escaped = !departure->way_out.empty();
    PLUMESCOUT_RETURN_IF_ERROR(PlanFrom(*departure, belief, request, stop, plan));
  }
  if (plan.chosen >= 0) {
    const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
    plan.phase = PhaseOf(chosen.goal.kind);
    plan.trajectory =
        TimeTrajectory(chosen.path, pose.yaw_rad, options_.speed_mps, options_.dwell_s);
  }
  plan.explanation = Explain(plan, options_.selection);
  return plan;
}

absl::Status ComposedStrategy::PlanFrom(const Departure& departure, const Belief& belief,
                                        const PlanRequest& request, const StopFn& stop,
                                        plumescout::Plan& plan) const {
  const MissionOptions& mission = *belief.options;
  const InformationField field =
      MakeInformationField({*belief.traversable, *belief.gas_mean_ppm, *belief.gas_variance_ppm2,
                            mission.gas, mission.frontier},
                           options_);
  plan.field_flat = field.flat;
  const Cell start_cell = belief.geometry().CellAt(departure.start);
  const Grid<std::uint8_t> reachable = ReachableCells(*belief.traversable, {start_cell});
  if (stop()) return Stopped();

  Rng rng(plan.seed ^ kGoalStream);
  GoalSet goals =
      FindGoals({belief, belief.robots.at(request.robot), start_cell, reachable, options_}, rng);
  plan.rejected = std::move(goals.rejected);
  if (goals.goals.empty()) {
    plan.end = goals.complete ? PlanEnd::kMissionComplete : PlanEnd::kNoGoals;
    plan.phase = goals.complete ? MissionPhase::kComplete : MissionPhase::kFallback;
    return absl::OkStatus();
  }
  if (stop()) return Stopped();

  const EdgeCost cost(field, options_.cost, options_.alpha);
  const PathResult result = FindPaths({cost, reachable, departure.start, goals.goals, plan.seed,
                                       request.max_edge_evaluations, stop});
  const EdgeCost selection_cost(field, options_.selection_cost, options_.alpha);
  TakeResults(goals.goals, result,
              {selection_cost, *belief.gas_mean_ppm, mission.gas.background_mean_ppm}, plan);
  for (Candidate& candidate : plan.candidates) PutBefore(departure.way_out, candidate);
  const bool budget_spent = request.max_edge_evaluations > 0 &&
                            plan.effort.edges_evaluated >= request.max_edge_evaluations;
  const bool stopped_empty = plan.end == PlanEnd::kStopped && plan.candidates.empty();
  return stopped_empty && !budget_spent ? Stopped() : absl::OkStatus();
}

PathResult ComposedStrategy::FindPaths(const PathProblem& problem) const {
  PathResult result = paths_->FindPaths(problem);
  if (options_.grid_guard && result.end == PlanEnd::kQueueExhausted) {
    CompleteOnGrid(problem, result);
  }
  return result;
}

void ComposedStrategy::TakeResults(const std::vector<Goal>& goals, const PathResult& result,
                                   const CandidateJudge& judge, plumescout::Plan& plan) const {
  plan.end = result.end;
  plan.effort = result.effort;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    if (const std::optional<FoundPath>& path = result.paths[i]) {
      plan.candidates.push_back(MakeCandidate(goals[i], path->vertices, path->source, judge));
    } else if (result.end == PlanEnd::kStopped) {
      plan.rejected.push_back({goals[i], RejectionReason::kSearchStopped, ""});
    } else {
      plan.rejected.push_back({goals[i], RejectionReason::kUnreachable, "the search ran out"});
    }
  }
  plan.chosen = SelectCandidate(plan.candidates, options_.selection);
}

}  // namespace

std::vector<std::string> StrategyNames() {
  std::vector<std::string> names;
  for (const StrategyRow& row : kRows) names.emplace_back(row.name);
  return names;
}

absl::Status ApplyStrategyRow(PlanningOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const StrategyRow row, FindRow(options.strategy));
  options.goals = row.goals;
  options.cost = CostKind::kUcb;
  options.selection_cost = CostKind::kUcb;
  options.selection = SelectionRule::kLeastCost;
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<const Strategy>> MakeStrategy(const PlanningOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  PLUMESCOUT_RETURN_IF_ERROR(FindRow(options.strategy).status());
  return std::make_unique<const ComposedStrategy>(options);
}

}  // namespace plumescout
