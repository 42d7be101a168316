// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/ingest_service.pb.h"
#include "plumescout/v1/planning_service.pb.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/observation.h"
#include "server/config/config.h"
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

inline v1::Observation& FirstObservation(Message& request) {
  return *static_cast<v1::BatchIngestObservationsRequest&>(request)
              .mutable_batch()
              ->mutable_observations(0);
}

// A scan of so many beams.
inline std::function<void(Message&)> Beams(std::size_t beams) {
  return [beams](Message& request) {
    FirstObservation(request).mutable_scan()->mutable_ranges_u16()->assign(2 * beams, '\x01');
  };
}

// A gap from its sequence on.
inline std::function<void(Message&)> GapUpTo(std::int64_t last) {
  return [last](Message& request) {
    v1::Observation& observation = FirstObservation(request);
    observation.mutable_gap()->set_first_sequence(observation.sequence());
    observation.mutable_gap()->set_last_sequence(last);
  };
}

// Batches that are refused whole: nothing of them enters the log.
inline BadInputs BadBatch() {
  using Request = v1::BatchIngestObservationsRequest;
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  return BadInputs()
      .Rows(BadRobotName("open.robot"))
      .Rows(UnknownMission("open.robot"))
      .Rows(BadLease("open.lease_token"))
      .Row({"batch.observations", "none",
            [](Message& m) { static_cast<Request&>(m).mutable_batch()->clear_observations(); },
            kInvalid, "batch.observations"})
      .Row({"batch.observations", "more than the server takes at once",
            [](Message& m) {
              FirstObservation(m).mutable_gas();  // many of which still make a small message
              auto& observations =
                  *static_cast<Request&>(m).mutable_batch()->mutable_observations();
              const v1::Observation first = observations.Get(0);
              while (observations.size() <= LimitConfig{}.max_batch_observations) {
                *observations.Add() = first;
              }
            },
            kInvalid, "batch.observations"})
      .ValuesBlaming(
          "batch.observations[0].sequence", "batch.observations.sequence",
          {"-1", "0", "2305843009213693953", "9223372036854775807", "-9223372036854775808"})
      .Row(
          {"batch.observations.sequence", "a hole",
           [](Message& m) { FirstObservation(m).set_sequence(FirstObservation(m).sequence() + 1); },
           absl::StatusCode::kFailedPrecondition, "SEQUENCE_GAP"})
      .Row({"batch.observations.scan.ranges_u16", "a million beams", Beams(1'000'000),
            absl::StatusCode::kResourceExhausted, ""});
}

// Observations that are refused singly, and counted in the log.
inline BadInputs BadObservation() {
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  const std::string o = "batch.observations.";
  BadInputs rows;
  const auto values = [&](const std::string& field, std::initializer_list<const char*> values) {
    rows.ValuesBlaming("observation." + field, o + field, values);
  };
  values("sample_time_ns", {"-1", "9223372036854775807", "4611686018427387904"});
  values("pose.x_m", {"nan", "inf", "-inf", "1001", "-1001", "1e300"});
  values("pose.y_m", {"nan", "inf", "-inf", "1001", "-1001", "1e300"});
  values("pose.yaw_rad", {"nan", "inf", "-inf"});
  values("scan.start_angle_rad", {"nan", "inf", "-inf", "7", "-7"});
  values("scan.angle_step_rad", {"nan", "inf", "-inf", "0", "7", "-7"});
  values("scan.max_range_m", {"nan", "inf", "-1", "0", "101", "1e300"});
  values("scan.range_unit_m", {"nan", "inf", "-1", "0", "2", "1e300"});
  values("scan.ranges_u16", {R"("")", R"("x")"});
  values("gas.concentration_ppm", {"nan", "inf", "-inf", "-1", "1e7"});
  values("gas.stddev_ppm", {"nan", "inf", "-1", "1e300", "1e-300", "1e7", "1e-6"});
  values("gap.first_sequence", {"-1", "0", "9223372036854775807"});
  return rows
      .Row({o + "pose", "missing", [](Message& m) { FirstObservation(m).clear_pose(); }, kInvalid,
            "observation.pose"})
      .Row({o + "payload", "missing", [](Message& m) { FirstObservation(m).clear_payload(); },
            kInvalid, "observation.payload"})
      .Row({o + "scan.ranges_u16", "more beams than the mission allows", Beams(20'001), kInvalid,
            "observation.scan.ranges_u16"})
      .Row({o + "scan.ranges_u16", "more beams than any mission allows", Beams(100'001), kInvalid,
            "observation.scan.ranges_u16"})
      .Row({o + "gap.last_sequence", "before the first", GapUpTo(0), kInvalid,
            "observation.gap.last_sequence"})
      .Row({o + "gap.last_sequence", "beyond all numbers", GapUpTo(kMaxSequence + 1), kInvalid,
            "observation.gap.last_sequence"});
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

// Of a request with a path.
inline BadInputs BadCheckTrajectory() {
  using Request = v1::CheckTrajectoryRequest;
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  const std::initializer_list<const char*> off = {"nan", "inf", "-inf", "1001", "-1e300"};
  return BadInputs()
      .Rows(BadRobotName("robot"))
      .Rows(UnknownMission("robot"))
      .Rows(BadLease("lease_token"))
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
