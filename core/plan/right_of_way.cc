// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/right_of_way.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/plan/precedence.h"
#include "core/plan/selection/selection.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

constexpr double kRounding_s = 1e-6;  // a wait is more

// Of strategies that sample sites the robot stands at those alone.
Trajectory Timed(const Candidate& candidate, double start_yaw_rad, const PlanningOptions& options) {
  return candidate.stops.empty()
             ? TimeTrajectory(candidate.path, start_yaw_rad, options)
             : TimeTrajectory(candidate.path, candidate.stops, start_yaw_rad, options);
}

bool HasToYield(const Belief& belief, const PlanningOptions& options, const Plan& plan) {
  return options.yield_to_robots && belief.robots.size() > 1 && !plan.candidates.empty();
}

RejectedGoal InTraffic(const Candidate& candidate, const Meeting& meeting) {
  return {candidate.goal, RejectionReason::kTraffic,
          absl::StrFormat("it would meet robot \"%s\" at (%.1f, %.1f) in %.1f s", meeting.robot,
                          meeting.place.x_m, meeting.place.y_m, meeting.time_s)};
}

}  // namespace

Traffic TrafficAround(const Belief& belief, const RobotId& robot, const PlanningOptions& options) {
  Traffic traffic(belief.robots, robot, options.robot_clearance_m, belief.sample_time_ns);
  for (const KeptWay& kept : KeptWays(belief, robot, options)) {
    traffic.KeepWay(belief.robots.at(kept.robot).state, kept.trajectory);
  }
  return traffic;
}

Traffic TrafficFor(const Belief& belief, const Plan& plan, const PlanningOptions& options) {
  const bool goes_home =
      plan.phase == MissionPhase::kReturning || IsSentHome(belief.robots.at(plan.robot));
  if (!goes_home) return TrafficAround(belief, plan.robot, options);
  return {belief.robots, plan.robot, options.robot_clearance_m, belief.sample_time_ns};
}

std::optional<Waits> FindWaits(const Belief& belief, double start_yaw_rad,
                               const PlanningOptions& options, const Plan& plan) {
  if (!HasToYield(belief, options, plan)) return std::nullopt;
  Waits waits{TrafficFor(belief, plan, options), {}};
  for (const Candidate& candidate : plan.candidates) {
    waits.waits_s.push_back(waits.traffic.LeastWait_s(Timed(candidate, start_yaw_rad, options)));
  }
  return waits;
}

std::optional<Waits> FindWaitsUntil(const StopFn& stop, const Belief& belief, double start_yaw_rad,
                                    const PlanningOptions& options, Plan& plan) {
  if (!HasToYield(belief, options, plan)) return std::nullopt;
  Waits waits{TrafficFor(belief, plan, options), {}};
  const auto add = [&](const Candidate& candidate) {
    waits.waits_s.push_back(waits.traffic.LeastWait_s(Timed(candidate, start_yaw_rad, options)));
    return waits.waits_s.back().has_value();
  };
  std::vector<Candidate> left = std::exchange(plan.candidates, {});
  std::reverse(left.begin(), left.end());
  while (!left.empty() && !Stops(stop)) {
    add(left.back());
    plan.candidates.push_back(std::move(left.back()));
    left.pop_back();
  }
  for (bool is_clear = false; !left.empty() && !is_clear;) {
    const auto best = left.begin() + SelectCandidate(left, options);
    is_clear = add(*best);
    plan.candidates.push_back(std::move(*best));
    left.erase(best);
  }
  for (Candidate& candidate : left) {
    plan.rejected.push_back({std::move(candidate.goal), RejectionReason::kSearchStopped, ""});
    plan.end = PlanEnd::kStopped;
  }
  return waits;
}

void YieldToRobots(const Belief& belief, double start_yaw_rad, const PlanningOptions& options,
                   Plan& plan) {
  const std::optional<Waits> waits = FindWaits(belief, start_yaw_rad, options, plan);
  if (waits) YieldToRobots(*waits, start_yaw_rad, options, plan);
}

void YieldToRobots(const Waits& waits, double start_yaw_rad, const PlanningOptions& options,
                   Plan& plan) {
  std::vector<Candidate> clear;
  std::vector<Candidate> blocked;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    Candidate& candidate = plan.candidates[i];
    if (const std::optional<double> wait_s = waits.waits_s[i]) {
      candidate.duration_s += *wait_s;
      clear.push_back(std::move(candidate));
    } else {
      blocked.push_back(std::move(candidate));
    }
  }
  std::stable_sort(blocked.begin(), blocked.end(), [](const Candidate& a, const Candidate& b) {
    return a.duration_s < b.duration_s;
  });
  for (const Candidate& candidate : blocked) {
    const Trajectory trajectory = Timed(candidate, start_yaw_rad, options);
    const Meeting meeting = *waits.traffic.FirstMeeting(trajectory);
    if (clear.empty() && plan.waits_for.empty()) plan.waits_for = meeting.robot;
    plan.rejected.push_back(InTraffic(candidate, meeting));
  }
  plan.candidates = std::move(clear);
  if (plan.candidates.empty()) plan.end = PlanEnd::kAllGoalsRejected;
}

void NoteWhomItWaitsFor(const Belief& belief, double start_yaw_rad, const PlanningOptions& options,
                        Plan& plan) {
  const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
  const Trajectory at_once = Timed(chosen, start_yaw_rad, options);
  if (chosen.duration_s - at_once.duration_s <= kRounding_s) return;
  const std::optional<Meeting> meeting = TrafficFor(belief, plan, options).FirstMeeting(at_once);
  if (meeting) plan.waits_for = meeting->robot;
}

Trajectory TrajectoryOf(const Candidate& candidate, double start_yaw_rad,
                        const PlanningOptions& options) {
  Trajectory trajectory = Timed(candidate, start_yaw_rad, options);
  const double wait_s = candidate.duration_s - trajectory.duration_s;
  if (wait_s > kRounding_s) WaitAtStart(wait_s, trajectory);
  return trajectory;
}

}  // namespace plumescout
