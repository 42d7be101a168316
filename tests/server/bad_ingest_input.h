// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "plumescout/v1/ingest_service.pb.h"
#include "proto/convert/observation.h"
#include "server/config/config.h"
#include "tests/server/bad_input.h"
#include "tests/server/bad_robot_input.h"

namespace plumescout::server {

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
      .Values("batch.sent_time_ns", {"-1", "4611686018427387905", "-9223372036854775808"})
      .Row(
          {"batch.observations.sequence", "a hole",
           [](Message& m) { FirstObservation(m).set_sequence(FirstObservation(m).sequence() + 1); },
           absl::StatusCode::kFailedPrecondition, "SEQUENCE_GAP"})
      .Row({"batch.observations.scan.ranges_u16", "a million beams", Beams(1'000'000),
            absl::StatusCode::kResourceExhausted, ""});
}

// Of poses of before.
inline BadInputs BadCorrection() {
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  const std::string o = "batch.observations.";
  BadInputs rows;
  const std::string anchors = "observation.correction.anchors[0].";
  rows.ValuesBlaming(anchors + "sample_time_ns", o + "correction.anchors.sample_time_ns",
                     {"-1", "4611686018427387905", "9223372036854775807"});
  for (const char* axis : {"x_m", "y_m"}) {
    rows.ValuesBlaming(anchors + "pose." + axis, o + "correction.anchors.pose." + axis,
                       {"nan", "inf", "-inf", "1001", "-1e300"});
  }
  rows.ValuesBlaming(anchors + "pose.yaw_rad", o + "correction.anchors.pose.yaw_rad",
                     {"nan", "inf", "-inf"});
  const auto anchored = [](std::initializer_list<std::int64_t> times_ns) {
    return [times = std::vector<std::int64_t>(times_ns)](Message& message) {
      v1::PoseCorrection& correction = *FirstObservation(message).mutable_correction();
      for (const std::int64_t time_ns : times) {
        v1::PoseAnchor& anchor = *correction.add_anchors();
        anchor.set_sample_time_ns(time_ns);
        anchor.mutable_pose()->set_x_m(1.0);
      }
    };
  };
  return rows
      .Row({o + "correction.anchors", "none",
            [](Message& m) { FirstObservation(m).mutable_correction(); }, kInvalid,
            "observation.correction"})
      .Row({o + "correction.anchors", "5000 of them",
            [](Message& m) {
              v1::PoseCorrection& correction = *FirstObservation(m).mutable_correction();
              for (int i = 0; i < 5000; ++i) {
                v1::PoseAnchor& anchor = *correction.add_anchors();
                anchor.set_sample_time_ns(i + 1);
                anchor.mutable_pose()->set_x_m(1.0);
              }
            },
            kInvalid, "observation.correction"})
      .Row({o + "correction.anchors.pose", "missing",
            [](Message& m) {
              FirstObservation(m).mutable_correction()->add_anchors()->set_sample_time_ns(1);
            },
            kInvalid, anchors + "pose"})
      .Row({o + "correction.anchors.sample_time_ns", "descending", anchored({2, 1}), kInvalid,
            "observation.correction.anchors[1].sample_time_ns"})
      .Row({o + "correction.anchors.sample_time_ns", "a time never seen", anchored({1}), kInvalid,
            anchors + "sample_time_ns"})
      .Row({o + "correction.anchors.sample_time_ns", "later than the correction",
            anchored({4'000'000'000'000'000'000}), kInvalid, anchors + "sample_time_ns"});
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
  values("gas.sensor_index", {"-1", "1", "2147483647"});
  values("status.battery_share", {"nan", "inf", "-0.1", "2"});
  values("gap.first_sequence", {"-1", "0", "9223372036854775807"});
  return rows.Rows(BadCorrection())
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

}  // namespace plumescout::server
