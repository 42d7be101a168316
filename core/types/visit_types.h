// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/byte_archive.h"
#include "core/types/cell.h"
#include "core/types/cell_state.h"
#include "core/types/grid_geometry.h"
#include "core/types/map_snapshot.h"
#include "core/types/plan.h"
#include "core/types/polygon.h"
#include "core/types/pose2.h"
#include "core/types/trajectory.h"

namespace plumescout {

// How archives visit types of this folder. Each switch names all enumerators, so that one more does
// not compile until it is added here.

constexpr bool IsOne(CellState state) {
  switch (state) {
    case CellState::kUnknown:
    case CellState::kFree:
    case CellState::kOccupied:
      return true;
  }
  return false;
}
constexpr bool IsOne(MissionPhase phase) {
  switch (phase) {
    case MissionPhase::kExploring:
    case MissionPhase::kGasProbing:
    case MissionPhase::kFallback:
    case MissionPhase::kComplete:
    case MissionPhase::kReturning:
    case MissionPhase::kSurvey:
    case MissionPhase::kSampling:
      return true;
  }
  return false;
}
constexpr bool IsOne(GoalKind kind) {
  switch (kind) {
    case GoalKind::kOccupancyFrontier:
    case GoalKind::kGasFrontier:
    case GoalKind::kRandomFreeSpace:
    case GoalKind::kHome:
    case GoalKind::kInformation:
    case GoalKind::kSite:
    case GoalKind::kMakeWay:
      return true;
  }
  return false;
}

void Visit(auto& archive, ConstOr<Cell> auto& cell) {
  auto& [x, y] = cell;
  archive(x, y);
}
void Visit(auto& archive, ConstOr<Point2> auto& point) {
  auto& [x_m, y_m] = point;
  archive(x_m, y_m);
}
void Visit(auto& archive, ConstOr<Polygon> auto& polygon) {
  auto& [vertices, name] = polygon;
  archive(vertices, name);
}
void Visit(auto& archive, ConstOr<Pose2> auto& pose) {
  auto& [x_m, y_m, yaw_rad] = pose;
  archive(x_m, y_m, yaw_rad);
}
void Visit(auto& archive, ConstOr<GridGeometry> auto& geometry) {
  auto& [origin_x_m, origin_y_m, resolution_m, width, height] = geometry;
  archive(origin_x_m, origin_y_m, resolution_m, width, height);
}
void Visit(auto& archive, ConstOr<Waypoint> auto& waypoint) {
  auto& [pose, arrival_time_s, dwell_s, speed_mps] = waypoint;
  archive(pose, arrival_time_s, dwell_s, speed_mps);
}
void Visit(auto& archive, ConstOr<Trajectory> auto& trajectory) {
  auto& [waypoints, length_m, duration_s] = trajectory;
  archive(waypoints, length_m, duration_s);
}
void Visit(auto& archive, ConstOr<Goal> auto& goal) {
  auto& [kind, cell, position, centroid, frontier_cells] = goal;
  archive(kind, cell, position, centroid, frontier_cells);
}
void Visit(auto& archive, ConstOr<GasSensor> auto& sensor) {
  auto& [id, robot_from_sensor, stddev_ppm, offset_stddev_ppm, species, response_time_s] = sensor;
  archive(id, robot_from_sensor, stddev_ppm, offset_stddev_ppm);
  archive.Since(2, species, response_time_s);
}
void Visit(auto& archive, ConstOr<RobotFrame> auto& frame) {
  auto& [mission_from_robot, position_stddev_m, heading_stddev_rad] = frame;
  archive(mission_from_robot, position_stddev_m, heading_stddev_rad);
}
void Visit(auto& archive, ConstOr<RobotState> auto& robot) {
  auto& [id, radius_m, has_pose, pose, applied_sequence, rejected_observations, silent, frame,
         clock_offset_ns, battery_share, ordered_home, frame_suspect] = robot;
  archive(id, radius_m, has_pose, pose, applied_sequence, rejected_observations, silent);
  archive.Since(2, frame, clock_offset_ns, battery_share, ordered_home, frame_suspect);
}
void Visit(auto& archive, ConstOr<GasCounters> auto& counters) {
  auto& [readings, in_posterior, moved_to_neighbour, waiting] = counters;
  archive(readings, in_posterior, moved_to_neighbour, waiting);
}
void Visit(auto& archive, ConstOr<GasQuality> auto& quality) {
  auto& [mean_error_ppm, variance_error_ratio, aged_to_ns, ageing_error_ratio, refreshes, epochs,
         healed, failures, drift_mean_ppm, drift_variance_ratio, noise_scale, noise_log_stddev,
         prior_precision_scale, prior_precision_log_stddev, clean_air_scale] = quality;
  // The last five follow from the field.
  archive(mean_error_ppm, variance_error_ratio, aged_to_ns, ageing_error_ratio, refreshes, epochs,
          healed, failures, drift_mean_ppm, drift_variance_ratio);
}

}  // namespace plumescout
