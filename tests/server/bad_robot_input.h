// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/planning_service.pb.h"
#include "proto/convert/inquiry.h"
#include "tests/server/bad_input.h"
#include "tests/server/bad_mission_input.h"

namespace plumescout::server {

inline BadInputs BadRobotName(const std::string& field) {
  return BadInputs()
      .Values(field, {R"("")", R"("r1")", R"("missions/hall")", R"("missions/hall/robots/")",
                      R"("missions/hall/robots/R1")", R"("missions//robots/r1")",
                      R"("missions/hall/robots/r1/")", R"("missions/hall/plans/1")"})
      .Value(field, R"("missions/hall/robots/r9")", absl::StatusCode::kNotFound, "ROBOT_NOT_FOUND");
}

inline BadInputs UnknownMission(const std::string& robot_field) {
  return BadInputs().Value(robot_field, R"("missions/attic/robots/r1")",
                           absl::StatusCode::kNotFound, "MISSION_NOT_FOUND");
}

inline BadInputs BadLease(const std::string& field) {
  BadInputs rows;
  for (const char* token : {"0", "-1", "9223372036854775807"}) {
    rows.Value(field, token, absl::StatusCode::kFailedPrecondition, "LEASE_SUPERSEDED");
  }
  return rows;
}

inline BadInputs BadGetRobot() {
  return BadInputs().Rows(BadRobotName("name")).Rows(UnknownMission("name"));
}

inline BadInputs BadListRobots() {
  return BadInputs().Rows(BadMissionName("mission")).Rows(BadListMissions());
}

inline BadInputs BadRemoveRobot() {
  return BadInputs()
      .Rows(BadRobotName("robot"))
      .Rows(UnknownMission("robot"))
      .Rows(BadLease("lease_token"));
}

// Of calls that operators may make without a lease: no token at all is theirs.
inline BadInputs BadLeaseIfAny() {
  BadInputs rows;
  for (const char* token : {"1", "-1", "9223372036854775807"}) {
    rows.Value("lease_token", token, absl::StatusCode::kFailedPrecondition, "LEASE_SUPERSEDED");
  }
  return rows;
}

inline BadInputs BadWatchRobot() {
  return BadInputs()
      .Rows(BadRobotName("robot"))
      .Rows(UnknownMission("robot"))
      .Rows(BadLeaseIfAny());
}

inline BadInputs BadNextBest() {
  return BadInputs()
      .Rows(BadRobotName("robot"))
      .Rows(UnknownMission("robot"))
      .Rows(BadLease("lease_token"))
      .Values("start.x_m", {"nan", "inf", "-inf"})
      .Values("start.y_m", {"nan", "inf", "-inf"})
      .Values("start.yaw_rad", {"nan", "inf", "-inf"})
      .ValuesBlaming("start", "start.x_m", {"500", "-1e300", "1e300"})
      .ValuesBlaming("start", "start.y_m", {"500", "-1e300", "1e300"})
      .Values("min_applied_sequence", {"-1", "2305843009213693953"})
      .Values("planning_budget.seconds", {"-1", "315576000001", "9223372036854775807"})
      .Values("planning_budget.nanos", {"-1", "1000000000"})
      .Values("max_edge_evaluation_count", {"-1"});
}

inline BadInputs BadPlanTeam() {
  return BadInputs()
      .Rows(BadMissionName("mission"))
      .Rows(BadRequestId())
      .Values("robots", {R"("")", R"("r1")", R"("missions/hall")", R"("missions/hall/robots/R1")",
                         R"("missions/attic/robots/r1")"})
      .Row({"robots", "named twice",
            [](Message& message) {
              SetField(message, "robots", R"("missions/hall/robots/r1")");
              SetField(message, "robots", R"("missions/hall/robots/r1")");
            },
            absl::StatusCode::kInvalidArgument, "robots"})
      .Row({"robots", "a team of 33",
            [](Message& message) {
              for (int i = 0; i < 33; ++i) {
                SetField(message, "robots", absl::StrCat("\"missions/hall/robots/t", i, "\""));
              }
            },
            absl::StatusCode::kInvalidArgument, "robots.size"})
      .Value("robots", R"("missions/hall/robots/r9")", absl::StatusCode::kNotFound,
             "ROBOT_NOT_FOUND")
      .Values("planning_budget.seconds", {"-1", "315576000001", "9223372036854775807"})
      .Values("planning_budget.nanos", {"-1", "1000000000"})
      .Values("max_order_count", {"-1", "35"})
      .Values("max_edge_evaluation_count", {"-1"});
}

// Of a request with a path.
inline BadInputs BadCheckTrajectory() {
  using Request = v1::CheckTrajectoryRequest;
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  const std::initializer_list<const char*> off = {"nan", "inf", "-inf", "1001", "-1e300"};
  return BadInputs()
      .Rows(BadRobotName("robot"))
      .Rows(UnknownMission("robot"))
      .Rows(BadLeaseIfAny())
      .Values("min_applied_sequence", {"-1", "2305843009213693953"})
      .Row({"subject", "none", [](Message& m) { static_cast<Request&>(m).clear_subject(); },
            kInvalid, "subject"})
      .Values("plan",
              {R"("")", R"("1")", R"("missions/hall/plans/0")", R"("missions/attic/plans/1")"})
      .Value("plan", R"("missions/hall/plans/99")", absl::StatusCode::kNotFound, "NOT_FOUND")
      .Row({"path", "empty",
            [](Message& m) { static_cast<Request&>(m).mutable_path()->clear_vertices(); }, kInvalid,
            "path.vertices"})
      .Row({"path.vertices", "too many",
            [](Message& m) {
              auto& vertices = *static_cast<Request&>(m).mutable_path()->mutable_vertices();
              while (vertices.size() <= kMaxPoints) vertices.Add();
            },
            kInvalid, "path.vertices"})
      .ValuesBlaming("path.vertices[0].x_m", "path.vertices.x_m", off)
      .ValuesBlaming("path.vertices[0].y_m", "path.vertices.y_m", off)
      .Values("path.goal_kind", {"0", "99", "-1"});
}

inline BadInputs BadReportProgress() {
  return BadInputs()
      .Rows(BadRobotName("robot"))
      .Rows(BadLease("lease_token"))
      .Rows(BadRequestId())
      .Values("plan",
              {R"("")", R"("1")", R"("missions/hall/plans/")", R"("missions/hall/plans/0")",
               R"("missions/hall/plans/-1")", R"("missions/hall/plans/01")",
               R"("missions/hall/plans/1.0")", R"("missions/hall/plans/9223372036854775808")",
               R"("missions/attic/plans/1")"})
      .Value("plan", R"("missions/hall/plans/99")", absl::StatusCode::kNotFound, "NOT_FOUND")
      .Row({"robot", "of an unknown mission, and its plan",
            [](Message& message) {
              SetField(message, "robot", R"("missions/attic/robots/r1")");
              SetField(message, "plan", R"("missions/attic/plans/1")");
            },
            absl::StatusCode::kNotFound, "MISSION_NOT_FOUND"})
      .Values("outcome", {"0", "99", "-1"});
}

}  // namespace plumescout::server
