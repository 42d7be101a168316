// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <type_traits>

#include "core/types/event.h"
#include "formats/journal/event_codec.h"

namespace plumescout::journal {

// A struct is visited by naming all its members in a structured binding, so that a member added to
// the struct does not compile until it is added here: then the kinds of records that hold it get a
// new version, and a decoder of the old one. The same list serves both directions.
template <typename T, typename Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

void VisitMembers(auto& archive, Is<Cell> auto& cell) {
  auto& [x, y] = cell;
  archive(x, y);
}
void VisitMembers(auto& archive, Is<Point2> auto& point) {
  auto& [x_m, y_m] = point;
  archive(x_m, y_m);
}
void VisitMembers(auto& archive, Is<Polygon> auto& polygon) {
  auto& [vertices, name] = polygon;
  archive(vertices, name);
}
void VisitMembers(auto& archive, Is<Pose2> auto& pose) {
  auto& [x_m, y_m, yaw_rad] = pose;
  archive(x_m, y_m, yaw_rad);
}
void VisitMembers(auto& archive, Is<Scan> auto& scan) {
  auto& [start_angle_rad, angle_step_rad, max_range_m, ranges_m] = scan;
  archive(start_angle_rad, angle_step_rad, max_range_m, ranges_m);
}
void VisitMembers(auto& archive, Is<GasReading> auto& reading) {
  auto& [concentration_ppm, variance_ppm2, sensor] = reading;
  // The sensor is in records of other than the first only: see event_codec.cc.
  archive(concentration_ppm, variance_ppm2);
}
void VisitMembers(auto& archive, Is<SequenceGap> auto& gap) {
  auto& [first_sequence, last_sequence] = gap;
  archive(first_sequence, last_sequence);
}
void VisitMembers(auto& archive, Is<PoseAnchor> auto& anchor) {
  auto& [sample_time_ns, pose] = anchor;
  archive(sample_time_ns, pose);
}
void VisitMembers(auto& archive, Is<PoseCorrection> auto& correction) {
  auto& [anchors] = correction;
  archive(anchors);
}
void VisitMembers(auto& archive, Is<RobotStatus> auto& status) {
  auto& [battery_share] = status;
  archive(battery_share);
}
void VisitMembers(auto& archive, Is<Observation> auto& observation) {
  auto& [sequence, sample_time_ns, pose, payload] = observation;
  archive(sequence, sample_time_ns, pose, payload);
}
void VisitMembers(auto& archive, Is<Waypoint> auto& waypoint) {
  auto& [pose, arrival_time_s, dwell_s, speed_mps] = waypoint;
  archive(pose, arrival_time_s, dwell_s, speed_mps);
}
void VisitMembers(auto& archive, Is<Trajectory> auto& trajectory) {
  auto& [waypoints, length_m, duration_s] = trajectory;
  archive(waypoints, length_m, duration_s);
}
void VisitMembers(auto& archive, Is<Goal> auto& goal) {
  auto& [kind, cell, position, centroid, frontier_cells] = goal;
  archive(kind, cell, position, centroid, frontier_cells);
}
void VisitMembers(auto& archive, Is<Candidate> auto& candidate) {
  auto& [goal, path, source, cost, penalty, length_m, mean_ucb, mean_ppm, duration_s,
         information_nats, information_bound_nats, unseen_share, reward, stops] = candidate;
  static_cast<void>(information_bound_nats);  // for who asked
  static_cast<void>(unseen_share);            // likewise
  archive(goal, path, source, cost, penalty, length_m, mean_ucb, mean_ppm, duration_s,
          information_nats, reward, stops);
}
void VisitMembers(auto& archive, Is<RejectedGoal> auto& rejected) {
  auto& [goal, reason, detail] = rejected;
  archive(goal, reason, detail);
}
void VisitMembers(auto& archive, Is<PlanEffort> auto& effort) {
  auto& [samples, vertices, edges_evaluated, goals_by_guard, batches] = effort;
  archive(samples, vertices, edges_evaluated, goals_by_guard, batches);
}
void VisitMembers(auto& archive, Is<Plan> auto& plan) {
  auto& [id, robot, strategy, belief_revision, seed, phase, end, chosen, candidates, rejected,
         trajectory, effort, field_flat, goal_kept, start_escaped, explanation, replan_after_s,
         waits_for, cpu_s] = plan;
  static_cast<void>(replan_after_s);  // for who asked
  static_cast<void>(waits_for);       // likewise
  archive(id, robot, strategy, belief_revision, seed, phase, end, chosen, candidates, rejected,
          trajectory, effort, field_flat, goal_kept, start_escaped, explanation, cpu_s);
}
void VisitMembers(auto& archive, Is<RobotFrame> auto& frame) {
  auto& [mission_from_robot, position_stddev_m, heading_stddev_rad] = frame;
  archive(mission_from_robot, position_stddev_m, heading_stddev_rad);
}
void VisitMembers(auto& archive, Is<GasSensor> auto& sensor) {
  auto& [id, robot_from_sensor, stddev_ppm, offset_stddev_ppm, species, response_time_s] = sensor;
  archive(id, robot_from_sensor, stddev_ppm, offset_stddev_ppm, species, response_time_s);
}
void VisitMembers(auto& archive, Is<RobotRegistered> auto& event) {
  auto& [robot, radius_m, lease_token, log_epoch, frame, sensors] = event;
  // The last two are in records that have them only: see event_codec.cc.
  archive(robot, radius_m, lease_token, log_epoch);
}
void VisitMembers(auto& archive, Is<ObservationReceived> auto& event) {
  auto& [robot, observation] = event;
  archive(robot, observation);
}
void VisitMembers(auto& archive, Is<PosteriorRefreshed> auto& event) {
  auto& [time_ns] = event;
  archive(time_ns);
}
void VisitMembers(auto& archive, Is<PlanIssued> auto& event) {
  auto& [plan, assigned] = event;
  // Whether it was assigned is in records of plans that were only.
  archive(plan);
}
void VisitMembers(auto& archive, Is<ProgressReported> auto& event) {
  auto& [robot, plan_id, outcome] = event;
  archive(robot, plan_id, outcome);
}
void VisitMembers(auto& archive, Is<EpochBegun> auto& event) {
  auto& [time_ns] = event;
  archive(time_ns);
}
void VisitMembers(auto&, Is<EpochAdopted> auto&) {
  static_assert(std::is_empty_v<EpochAdopted>);  // no members, so no binding to name them in
}
void VisitMembers(auto& archive, Is<RobotRemoved> auto& event) {
  auto& [robot] = event;
  archive(robot);
}
void VisitMembers(auto& archive, Is<ClockOffsetNoted> auto& event) {
  auto& [robot, offset_ns] = event;
  archive(robot, offset_ns);
}
void VisitMembers(auto& archive, Is<HomeOrdered> auto& event) {
  auto& [robot, home] = event;
  archive(robot, home);
}
void VisitMembers(auto&, Is<MapRebuildBegun> auto&) {
  static_assert(std::is_empty_v<MapRebuildBegun>);
}
void VisitMembers(auto&, Is<MapRebuilt> auto&) { static_assert(std::is_empty_v<MapRebuilt>); }
void VisitMembers(auto& archive, Is<KeepOutChanged> auto& event) {
  auto& [deleted, added] = event;
  archive(deleted, added);
}
void VisitMembers(auto& archive, Is<JournalStart> auto& start) {
  auto& [code_version, mission_options, mission, owner, tenant, created_ns, last_number,
         last_digest] = start;
  // The last two are in starts that have them only: see event_codec.cc.
  archive(code_version, mission_options, mission, owner, tenant, created_ns);
}

}  // namespace plumescout::journal
