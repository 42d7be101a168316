// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/names.h"

namespace plumescout {
namespace {

// The helpers below overload these rather than hide them.
using plumescout::FromProto;
using plumescout::ToProto;

constexpr double kNanosecondsPerSecond = 1e9;

v1::PlanEffort ToProto(const PlanEffort& effort) {
  v1::PlanEffort proto;
  proto.set_sample_count(effort.samples);
  proto.set_vertex_count(effort.vertices);
  proto.set_edge_evaluation_count(effort.edges_evaluated);
  proto.set_guarded_goal_count(effort.goals_by_guard);
  proto.set_batch_count(effort.batches);
  return proto;
}

absl::Status CheckPrice(const v1::Candidate& proto, absl::string_view field) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "cost"), proto.cost()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckFinite(Join(field, "information_penalty"), proto.information_penalty()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "length_m"), proto.length_m()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "mean_ucb"), proto.mean_ucb()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "duration_s"), proto.duration_s()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckFinite(Join(field, "expected_information_nats"), proto.expected_information_nats()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "expected_information_bound_nats"),
                                         proto.expected_information_bound_nats()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckRange(Join(field, "unseen_share"), proto.unseen_share(), 0.0, 1.0));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "reward"), proto.reward()));
  return CheckFinite(Join(field, "mean_concentration_ppm"), proto.mean_concentration_ppm());
}

absl::StatusOr<Waypoint> FromProto(const v1::Waypoint& proto, absl::string_view field) {
  Waypoint waypoint;
  PLUMESCOUT_ASSIGN_OR_RETURN(waypoint.pose, FromProto(proto.pose(), Join(field, "pose")));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckNotNegative(Join(field, "arrival_time_s"), proto.arrival_time_s()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "dwell_s"), proto.dwell_s()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "speed_mps"), proto.speed_mps()));
  waypoint.arrival_time_s = proto.arrival_time_s();
  waypoint.dwell_s = proto.dwell_s();
  waypoint.speed_mps = proto.speed_mps();
  return waypoint;
}

PlanEffort FromProto(const v1::PlanEffort& proto) {
  return {proto.sample_count(), proto.vertex_count(), proto.edge_evaluation_count(),
          proto.guarded_goal_count(), proto.batch_count()};
}

absl::Status ReadNames(const v1::Plan& proto, absl::string_view field, Plan& plan) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName robot,
                              ParseRobotName(Join(field, "robot"), proto.robot()));
  plan.robot = robot.robot;
  if (!proto.waits_for().empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName other,
                                ParseRobotName(Join(field, "waits_for"), proto.waits_for()));
    plan.waits_for = other.robot;
  }
  if (proto.name().empty()) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanName name,
                              ParsePlanName(Join(field, "name"), proto.name()));
  plan.id = name.plan;
  return absl::OkStatus();
}

absl::Status ReadGoals(const v1::Plan& proto, absl::string_view field, Plan& plan) {
  for (int i = 0; i < proto.candidates_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Candidate candidate,
                                FromProto(proto.candidates(i), Join(field, "candidates", i)));
    plan.candidates.push_back(std::move(candidate));
  }
  for (int i = 0; i < proto.rejected_goals_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(RejectedGoal rejected, FromProto(proto.rejected_goals(i),
                                                                 Join(field, "rejected_goals", i)));
    plan.rejected.push_back(std::move(rejected));
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(Join(field, "chosen_index"), proto.chosen_index(), -1,
                                           proto.candidates_size() - 1));
  plan.chosen = proto.chosen_index();
  return absl::OkStatus();
}

}  // namespace

v1::Trajectory ToProto(const Trajectory& trajectory) {
  v1::Trajectory proto;
  for (const Waypoint& waypoint : trajectory.waypoints) {
    v1::Waypoint& added = *proto.add_waypoints();
    *added.mutable_pose() = ToProto(waypoint.pose);
    added.set_arrival_time_s(waypoint.arrival_time_s);
    added.set_dwell_s(waypoint.dwell_s);
    added.set_speed_mps(waypoint.speed_mps);
  }
  proto.set_length_m(trajectory.length_m);
  proto.set_duration_s(trajectory.duration_s);
  return proto;
}

v1::Goal ToProto(const Goal& goal) {
  v1::Goal proto;
  proto.set_kind(ToProto(goal.kind));
  *proto.mutable_cell() = ToProto(goal.cell);
  *proto.mutable_position() = ToProto(goal.position);
  *proto.mutable_centroid() = ToProto(goal.centroid);
  proto.set_frontier_cell_count(goal.frontier_cells);
  return proto;
}

v1::Candidate ToProto(const Candidate& candidate) {
  v1::Candidate proto;
  *proto.mutable_goal() = ToProto(candidate.goal);
  for (const Point2& point : candidate.path) *proto.add_path() = ToProto(point);
  proto.set_path_source(ToProto(candidate.path_source));
  proto.set_cost(candidate.cost);
  proto.set_information_penalty(candidate.information_penalty);
  proto.set_length_m(candidate.length_m);
  proto.set_mean_ucb(candidate.mean_ucb);
  proto.set_mean_concentration_ppm(candidate.mean_concentration_ppm);
  proto.set_duration_s(candidate.duration_s);
  if (candidate.expected_information_nats) {
    proto.set_expected_information_nats(*candidate.expected_information_nats);
  }
  if (candidate.information_bound_nats) {
    proto.set_expected_information_bound_nats(*candidate.information_bound_nats);
  }
  if (candidate.unseen_share != 1.0) proto.set_unseen_share(candidate.unseen_share);
  if (candidate.reward) proto.set_reward(*candidate.reward);
  for (const Point2& stop : candidate.stops) *proto.add_stops() = ToProto(stop);
  return proto;
}

v1::RejectedGoal ToProto(const RejectedGoal& rejected) {
  v1::RejectedGoal proto;
  *proto.mutable_goal() = ToProto(rejected.goal);
  proto.set_reason(ToProto(rejected.reason));
  proto.set_detail(rejected.detail);
  return proto;
}

v1::Plan ToProto(const Plan& plan, const MissionId& mission) {
  v1::Plan proto;
  if (plan.id > 0) proto.set_name(PlanResource({mission, plan.id}));
  proto.set_robot(RobotResource({mission, plan.robot}));
  proto.set_strategy(plan.strategy);
  proto.set_belief_revision(plan.belief_revision);
  proto.set_seed(static_cast<std::int64_t>(plan.seed));
  proto.set_phase(ToProto(plan.phase));
  proto.set_end(ToProto(plan.end));
  proto.set_chosen_index(plan.chosen);
  for (const Candidate& candidate : plan.candidates) *proto.add_candidates() = ToProto(candidate);
  for (const RejectedGoal& goal : plan.rejected) *proto.add_rejected_goals() = ToProto(goal);
  *proto.mutable_trajectory() = ToProto(plan.trajectory);
  *proto.mutable_effort() = ToProto(plan.effort);
  proto.set_field_flat(plan.field_flat);
  proto.set_goal_kept(plan.goal_kept);
  proto.set_start_escaped(plan.start_escaped);
  proto.set_explanation(plan.explanation);
  if (SamplesSites(plan)) proto.set_map_update_s(plan.trajectory.duration_s);
  if (plan.replan_after_s > 0.0) proto.set_replan_after_s(plan.replan_after_s);
  if (!plan.waits_for.empty()) proto.set_waits_for(RobotResource({mission, plan.waits_for}));
  const auto cpu_ns = std::llround(plan.cpu_s * kNanosecondsPerSecond);
  proto.mutable_cpu_duration()->set_seconds(cpu_ns / std::llround(kNanosecondsPerSecond));
  proto.mutable_cpu_duration()->set_nanos(
      static_cast<std::int32_t>(cpu_ns % std::llround(kNanosecondsPerSecond)));
  return proto;
}

absl::StatusOr<Goal> FromProto(const v1::Goal& proto, absl::string_view field) {
  Goal goal;
  PLUMESCOUT_ASSIGN_OR_RETURN(goal.kind, FromProto(proto.kind(), Join(field, "kind")));
  goal.cell = FromProto(proto.cell());
  PLUMESCOUT_ASSIGN_OR_RETURN(goal.position, FromProto(proto.position(), Join(field, "position")));
  PLUMESCOUT_ASSIGN_OR_RETURN(goal.centroid, FromProto(proto.centroid(), Join(field, "centroid")));
  goal.frontier_cells = proto.frontier_cell_count();
  return goal;
}

absl::StatusOr<Candidate> FromProto(const v1::Candidate& proto, absl::string_view field) {
  Candidate candidate;
  PLUMESCOUT_RETURN_IF_ERROR(CheckPrice(proto, field));
  PLUMESCOUT_ASSIGN_OR_RETURN(candidate.goal, FromProto(proto.goal(), Join(field, "goal")));
  for (int i = 0; i < proto.path_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 point,
                                FromProto(proto.path(i), Join(field, "path", i)));
    candidate.path.push_back(point);
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(candidate.path_source,
                              FromProto(proto.path_source(), Join(field, "path_source")));
  candidate.cost = proto.cost();
  candidate.information_penalty = proto.information_penalty();
  candidate.length_m = proto.length_m();
  candidate.mean_ucb = proto.mean_ucb();
  candidate.mean_concentration_ppm = proto.mean_concentration_ppm();
  candidate.duration_s = proto.duration_s();
  if (proto.has_expected_information_nats()) {
    candidate.expected_information_nats = proto.expected_information_nats();
  }
  if (proto.has_expected_information_bound_nats()) {
    candidate.information_bound_nats = proto.expected_information_bound_nats();
  }
  if (proto.has_unseen_share()) candidate.unseen_share = proto.unseen_share();
  if (proto.has_reward()) candidate.reward = proto.reward();
  for (int i = 0; i < proto.stops_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 stop,
                                FromProto(proto.stops(i), Join(field, "stops", i)));
    candidate.stops.push_back(stop);
  }
  return candidate;
}

absl::StatusOr<RejectedGoal> FromProto(const v1::RejectedGoal& proto, absl::string_view field) {
  RejectedGoal rejected;
  PLUMESCOUT_ASSIGN_OR_RETURN(rejected.goal, FromProto(proto.goal(), Join(field, "goal")));
  PLUMESCOUT_ASSIGN_OR_RETURN(rejected.reason, FromProto(proto.reason(), Join(field, "reason")));
  rejected.detail = proto.detail();
  return rejected;
}

absl::StatusOr<Trajectory> FromProto(const v1::Trajectory& proto, absl::string_view field) {
  Trajectory trajectory;
  for (int i = 0; i < proto.waypoints_size(); ++i) {
    const std::string waypoint_field = Join(field, "waypoints", i);
    PLUMESCOUT_ASSIGN_OR_RETURN(const Waypoint waypoint,
                                FromProto(proto.waypoints(i), waypoint_field));
    if (i > 0 && waypoint.arrival_time_s < trajectory.waypoints.back().arrival_time_s) {
      return FieldError(Join(waypoint_field, "arrival_time_s"), waypoint.arrival_time_s,
                        "is before the waypoint before it");
    }
    trajectory.waypoints.push_back(waypoint);
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "length_m"), proto.length_m()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "duration_s"), proto.duration_s()));
  trajectory.length_m = proto.length_m();
  trajectory.duration_s = proto.duration_s();
  return trajectory;
}

absl::StatusOr<Plan> FromProto(const v1::Plan& proto, absl::string_view field) {
  Plan plan;
  PLUMESCOUT_RETURN_IF_ERROR(ReadNames(proto, field, plan));
  PLUMESCOUT_RETURN_IF_ERROR(ReadGoals(proto, field, plan));
  PLUMESCOUT_ASSIGN_OR_RETURN(plan.phase, FromProto(proto.phase(), Join(field, "phase")));
  PLUMESCOUT_ASSIGN_OR_RETURN(plan.end, FromProto(proto.end(), Join(field, "end")));
  PLUMESCOUT_ASSIGN_OR_RETURN(plan.trajectory,
                              FromProto(proto.trajectory(), Join(field, "trajectory")));
  plan.strategy = proto.strategy();
  plan.belief_revision = proto.belief_revision();
  plan.seed = static_cast<std::uint64_t>(proto.seed());
  plan.effort = FromProto(proto.effort());
  plan.field_flat = proto.field_flat();
  plan.goal_kept = proto.goal_kept();
  plan.start_escaped = proto.start_escaped();
  plan.explanation = proto.explanation();
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckNotNegative(Join(field, "replan_after_s"), proto.replan_after_s()));
  plan.replan_after_s = proto.replan_after_s();
  plan.cpu_s = static_cast<double>(proto.cpu_duration().seconds()) +
               static_cast<double>(proto.cpu_duration().nanos()) / kNanosecondsPerSecond;
  return plan;
}

}  // namespace plumescout
