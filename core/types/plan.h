// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types/cell.h"
#include "core/types/ids.h"
#include "core/types/pose2.h"
#include "core/types/trajectory.h"

namespace plumescout {

enum class MissionPhase {
  kExploring,
  kGasProbing,
  kFallback,
  kComplete,
  kReturning,
  kSurvey,    // the low-resolution survey of [LHR]
  kSampling,  // site by site
};
enum class GoalKind {
  kOccupancyFrontier,
  kGasFrontier,
  kRandomFreeSpace,
  kHome,
  kInformation,
  kSite,     // where the robot stops and samples
  kMakeWay,  // out of another robot's way
};

// A place worth going to, as the goal policy hands it to the path planner.
struct Goal {
  GoalKind kind = GoalKind::kOccupancyFrontier;
  Cell cell;        // traversable; of the belief's geometry, which growth of the map may move
  Point2 position;  // centre of the cell: what claims and goal memory go by
  Point2 centroid;  // of the frontier; the cell's centre for random goals; home itself
  int frontier_cells = 0;

  friend bool operator==(const Goal&, const Goal&) = default;
};

// What a robot does that drives to such a goal.
inline MissionPhase PhaseToward(GoalKind kind) {
  switch (kind) {
    case GoalKind::kGasFrontier:
    case GoalKind::kInformation:
      return MissionPhase::kGasProbing;
    case GoalKind::kOccupancyFrontier:
      return MissionPhase::kExploring;
    case GoalKind::kHome:
      return MissionPhase::kReturning;
    case GoalKind::kSite:
      return MissionPhase::kSampling;
    case GoalKind::kRandomFreeSpace:
    case GoalKind::kMakeWay:
      break;
  }
  return MissionPhase::kFallback;
}

enum class PathSource { kTree, kGridGuard, kGridSearch };

// A goal with the path to it and every term of its price.
struct Candidate {
  Goal goal;
  std::vector<Point2> path;  // vertices in frame map, start first
  PathSource path_source = PathSource::kTree;
  double cost = 0.0;                 // J of [XIT] Eq. (13), under the selection cost
  double information_penalty = 0.0;  // sum of P over the path, in cells
  double length_m = 0.0;
  double mean_ucb = 0.0;  // mean of I-hat over the path, [MIT] Eq. (3)
  double mean_concentration_ppm = 0.0;
  double duration_s = 0.0;  // of its trajectory
  // By how much readings on the way are expected to lower the entropy of the gas field, weighted by
  // relevance; only where the selection asks for it and time allowed.
  std::optional<double> expected_information_nats;
  // Where that was not computed, for even this, which it is at most, would not have been chosen.
  // Events do not keep it.
  std::optional<double> information_bound_nats = std::nullopt;
  // Share of options.unseen_information_nats that counts, of a way to the edge of the unseen: what
  // live plans of others are not about to see of it. Events do not keep it.
  double unseen_share = 1.0;
  // Of strategies that sample sites: the reward of all stops on the way, in the unit of the reward.
  std::optional<double> reward = std::nullopt;
  std::vector<Point2> stops = {};  // of those strategies, in order; the goal is the last

  friend bool operator==(const Candidate&, const Candidate&) = default;
};

enum class RejectionReason {
  kUnreachable,    // no traversable way on the grid
  kTooSmall,       // fewer cells than the minimum frontier size
  kSetAside,       // goal memory: failed or visited without change, not yet expired
  kClaimed,        // another robot's live plan ends there
  kNotDrawn,       // more goals than max_goal_count; the draw passed it over
  kTooClose,       // nearer than the minimum travel distance
  kSearchStopped,  // deadline or cancel came before a path was found
  kOverBudget,     // too little of the travel budget would be left to drive home
  kKeptOut,        // in an area where nobody may drive
  kGone,           // of a check: no such goal is left
  kTraffic,        // another robot is on the way to it for longer than one would wait
  kOverDeadline,   // the robot would not be home by the mission's deadline
};

struct RejectedGoal {
  Goal goal;
  RejectionReason reason = RejectionReason::kUnreachable;
  std::string detail;  // e.g. the robot that claims it, the event at which a set-aside ends

  friend bool operator==(const RejectedGoal&, const RejectedGoal&) = default;
};

// A frontier as a goal of one robot.
struct JudgedFrontier {
  Goal goal;
  std::optional<double> travel_m;         // on the 8-connected grid; none if there is no way
  std::optional<RejectedGoal> rejection;  // why it is not offered
};

// How planning ended. The last four have no trajectory.
enum class PlanEnd {
  kAllGoalsReached,   // every goal has a path
  kQueueExhausted,    // some goal has none
  kStopped,           // deadline, budget or cancellation; paths found so far count
  kNoGoals,           // there is no place to go to
  kMissionComplete,   // nothing is left to do
  kStartOccupied,     // the robot stands where there is no way out to traversable cells
  kAllGoalsRejected,  // there are places to go to, each rejected for a reason
};

// How hard the search worked.
struct PlanEffort {
  int samples = 0;
  int vertices = 0;
  int edges_evaluated = 0;
  int goals_by_guard = 0;
  int batches = 0;  // of an anytime search; 0: there are none

  friend bool operator==(const PlanEffort&, const PlanEffort&) = default;
};

// Answer to "where next": the choice, everything it was chosen from, and why.
struct Plan {
  PlanId id = 0;  // 0 until the mission has committed the plan
  RobotId robot;
  std::string strategy;
  std::int64_t belief_revision = 0;
  std::uint64_t seed = 0;
  MissionPhase phase = MissionPhase::kExploring;
  PlanEnd end = PlanEnd::kNoGoals;
  int chosen = -1;  // index into candidates; -1: stay where you are
  std::vector<Candidate> candidates;
  std::vector<RejectedGoal> rejected;
  Trajectory trajectory;  // of the chosen candidate; empty if none
  PlanEffort effort;
  bool field_flat = false;     // the information map had no contrast: pure distance behaviour
  bool goal_kept = false;      // another was better, but not by the commitment margin
  bool start_escaped = false;  // the robot stood in the inflated zone; the path leads out first
  std::string explanation;     // one sentence for an operator
  // So long after it has set out the robot had better ask for another plan, and go on meanwhile; 0:
  // not before it is there. For who asked, and not in the committed event.
  double replan_after_s = 0.0;
  // Whom the robot lets pass first, before it leaves or while it stays; empty: nobody. As
  // replan_after_s.
  RobotId waits_for;
  // CPU time of planning, filled in by whoever ran the planner when it answers; 0 in the committed
  // event, which has to be the same whenever the run is repeated.
  double cpu_s = 0.0;

  friend bool operator==(const Plan&, const Plan&) = default;
};

// Whether the plan is to stop at sites: then its last sample is taken when its trajectory ends.
inline bool SamplesSites(const Plan& plan) {
  return plan.chosen >= 0 &&
         plan.candidates[static_cast<std::size_t>(plan.chosen)].goal.kind == GoalKind::kSite;
}

}  // namespace plumescout
