// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Fields of requests that need no row among bad inputs, by request and path.

#include <set>
#include <string>

#include "absl/strings/str_cat.h"

namespace plumescout::server {

// Both values of a bool are good.
inline std::set<std::string> BoolFields() {
  return {
      "CreateMissionRequest.options.stamp_by_arrival",
      "CreateMissionRequest.options.gas.estimate_noise",
      "CreateMissionRequest.options.gas.noise_by_level",
      "CreateMissionRequest.options.gas.background_by_area",
      "CreateMissionRequest.options.keep_scans",
      "CreateMissionRequest.options.planning.draw_goals",
      "CreateMissionRequest.options.planning.raw_variance",
      "CreateMissionRequest.options.planning.mixture_radius",
      "CreateMissionRequest.options.planning.grid_guard",
      "CreateMissionRequest.options.planning.fallback_to_unobserved",
      "CreateMissionRequest.options.planning.goal_vertices",
      "CreateMissionRequest.options.planning.informed_heuristic",
      "CreateMissionRequest.options.planning.straighten",
      "CreateMissionRequest.options.planning.return_home",
      "CreateMissionRequest.options.planning.yield_to_robots",
      "CreateMissionRequest.options.planning.anticipate_robots",
      "CreateMissionRequest.options.planning.balanced_areas",
      "CreateMissionRequest.options.planning.sites.survey",
      "NextBestTrajectoryRequest.go_home",
      "ListPlansRequest.with_latest",
      "StreamNextBestTrajectoryRequest.go_home",
      "PlanTeamRequest.go_home",
      "RegisterRobotRequest.take_over",
      "RemoveRobotRequest.force",
      "ReleaseLeaseRequest.force",
      "OrderHomeRequest.home",
      "GetMapRequest.full_precision",
      "GetMapRequest.fresh_posterior",
      "QueryGasRequest.fresh_posterior",
      "QueryGasRequest.with_verdicts",
      "WatchMapRequest.full_precision",
  };
}

// Fields of which no value is bad, and messages that may be missing.
inline std::set<std::string> FreeFields() {
  std::set<std::string> fields = {
      // Every number is a seed; 0 has a meaning of its own.
      "CreateMissionRequest.options.seed",
      "NextBestTrajectoryRequest.seed",
      "StreamNextBestTrajectoryRequest.seed",
      "PlanTeamRequest.seed",
      // What a server told the client; of one that says too much there is a test of recovery.
      "BatchIngestObservationsRequest.open.durable_sequence",
      "StreamObservationsRequest.open.durable_sequence",
      // Unset options are the server's.
      "CreateMissionRequest.options",
      "CreateMissionRequest.options.occupancy",
      "CreateMissionRequest.options.gas",
      "CreateMissionRequest.options.frontier",
      "CreateMissionRequest.options.planning",
      "CreateMissionRequest.options.objective",
      "CreateMissionRequest.options.planning.sites",
      "CreateMissionRequest.options.home",
      // Unset: the mission may idle for ever; or it lacks its name, of which there are rows.
      "CreateMissionRequest.idle_time_to_live",
      "UpdateMissionRequest.mission.idle_time_to_live",
      "UpdateMissionRequest.mission",
      // Unset: all of the map.
      "GetMapRequest.region",
      "WatchMapRequest.region",
      // Unset: the robot's latest pose, the server's budget.
      "NextBestTrajectoryRequest.start",
      "StreamNextBestTrajectoryRequest.start",
      "NextBestTrajectoryRequest.planning_budget",
      "StreamNextBestTrajectoryRequest.planning_budget",
      "PlanTeamRequest.planning_budget",
      // Unset: the mission's frame, the robot's pose.
      "RegisterRobotRequest.frame",
      "RegisterRobotRequest.frame.mission_from_robot",
      "RegisterRobotRequest.gas_sensors.robot_from_sensor",
      // Unset, they lack a name or observations, of which there are rows.
      "BatchIngestObservationsRequest.open",
      "BatchIngestObservationsRequest.batch",
      // What a frame holds; frames out of order and of nothing have a test in bad_input_test.cc.
      "StreamObservationsRequest.frame",
      "StreamObservationsRequest.open",
      "StreamObservationsRequest.batch",
      // The parts of an import, of which there are rows; those out of order have a test in
      // bad_input_test.cc.
      "ImportMissionRequest.part",
      "ImportMissionRequest.start",
      "ImportMissionRequest.piece",
      "ImportMissionRequest.end",
  };
  // Parts of the payload, of which there is a row.
  for (const char* payload : {"scan", "gas", "gap", "status", "correction"}) {
    for (const char* request : {"BatchIngestObservationsRequest", "StreamObservationsRequest"}) {
      fields.insert(absl::StrCat(request, ".batch.observations.", payload));
    }
  }
  fields.merge(BoolFields());
  return fields;
}

}  // namespace plumescout::server
