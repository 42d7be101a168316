// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>

#include "plumescout/v1/map_service.pb.h"
#include "proto/convert/inquiry.h"
#include "tests/server/bad_input.h"
#include "tests/server/bad_mission_input.h"

namespace plumescout::server {

// For requests whose region ends north and east of (0, 0).
template <typename Request>
BadInputs BadView() {
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  const std::initializer_list<const char*> off = {"nan", "inf", "-inf"};
  const std::initializer_list<const char*> before = {"nan", "inf", "-inf", "-0.5"};
  return BadInputs()
      .Rows(BadMissionName("mission"))
      .ValuesBlaming("layers[0]", "layers", {"0", "99", "-1"})
      .Row({"region.min", "unset",
            [](Message& m) { static_cast<Request&>(m).mutable_region()->clear_min(); }, kInvalid,
            "region.min"})
      .Row({"region.max", "unset",
            [](Message& m) { static_cast<Request&>(m).mutable_region()->clear_max(); }, kInvalid,
            "region.max"})
      .ValuesBlaming("species[0]", "species", {R"("ozone")"})
      .Row({"species", "twice the first",
            [](Message& m) {
              static_cast<Request&>(m).add_species("");
              static_cast<Request&>(m).add_species("");
            },
            kInvalid, "species[1]"})
      .Values("region.min.x_m", off)
      .Values("region.min.y_m", off)
      .Values("region.max.x_m", before)
      .Values("region.max.y_m", before)
      .Values("level_of_detail", {"-1", "7"});
}

template <typename Request>
Request GoodView() {
  Request request;
  request.set_mission("missions/hall");
  request.mutable_region()->mutable_min();
  request.mutable_region()->mutable_max()->set_x_m(5.0);
  request.mutable_region()->mutable_max()->set_y_m(5.0);
  return request;
}

inline BadInputs BadWatchMap() {
  return BadView<v1::WatchMapRequest>()
      .Values("from_revision", {"-1"})
      .Value("from_revision", "9223372036854775807", absl::StatusCode::kOutOfRange, "OUT_OF_RANGE")
      .Values("speed_ratio", {"nan", "inf", "-1", "0.0001", "1e7"});
}

inline BadInputs BadGetMap() {
  return BadView<v1::GetMapRequest>()
      .Values("part_token", {"\"x\"", "\"!\"", "\"MSAx\""})
      .Values("max_part_bytes", {"-1"})
      .Values("revision", {"-1"})
      .Value("revision", "9223372036854775807", absl::StatusCode::kOutOfRange, "OUT_OF_RANGE");
}

inline BadInputs BadQueryGas() {
  using Request = v1::QueryGasRequest;
  const auto kInvalid = absl::StatusCode::kInvalidArgument;
  const std::initializer_list<const char*> off = {"nan", "inf", "-inf", "1001", "-1e300"};
  return BadInputs()
      .Rows(BadMissionName("mission"))
      .Row({"points", "none", [](Message& m) { static_cast<Request&>(m).clear_points(); }, kInvalid,
            "points"})
      .Row({"points", "too many",
            [](Message& m) {
              while (static_cast<Request&>(m).points_size() <= kMaxPoints) {
                static_cast<Request&>(m).add_points();
              }
            },
            kInvalid, "points"})
      .ValuesBlaming("points[0].x_m", "points.x_m", off)
      .ValuesBlaming("points[0].y_m", "points.y_m", off)
      .Values("species", {R"("ozone")"})
      .Values("revision", {"-1"})
      .Value("revision", "9223372036854775807", absl::StatusCode::kOutOfRange, "OUT_OF_RANGE");
}

}  // namespace plumescout::server
