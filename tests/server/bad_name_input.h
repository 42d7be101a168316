// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumescout/v1/mission_service.pb.h"
#include "tests/server/bad_input.h"

namespace plumescout::server {

inline BadInputs BadMissionName(const std::string& field) {
  return BadInputs()
      .Values(field, {R"("")", R"("hall")", R"("missions")", R"("missions/")", R"("missions/Hall")",
                      R"("missions/hall/")", R"("missions/hall/robots/r1")", R"("/missions/hall")",
                      R"("missions/ha\0ll")", R"("plans/hall")"})
      .Value(field, R"("missions/attic")", absl::StatusCode::kNotFound, "MISSION_NOT_FOUND");
}

inline BadInputs BadId(const std::string& field) {
  static const std::string too_long = absl::StrCat("\"", std::string(64, 'a'), "\"");
  return BadInputs()
      .Values(field, {R"("")", R"("A")", R"("1a")", R"("-a")", R"("a-")", R"("a b")", R"("a/b")",
                      R"("a\0b")", R"("ä")"})
      .Values(field, {too_long.c_str()});
}

inline BadInputs BadRequestId() {
  static const std::string too_long = absl::StrCat("\"", std::string(65, 'a'), "\"");
  return BadInputs()
      .Values("request_id", {R"("a b")", R"("a\n")", R"("\001")"})
      .Values("request_id", {too_long.c_str()});
}

inline BadInputs BadTimeToLive(const std::string& field) {
  return BadInputs()
      .Values(absl::StrCat(field, ".seconds"), {"-1", "0", "315360001", "9223372036854775807"})
      .Row({absl::StrCat(field, ".nanos"), "-1",
            [field](Message& message) {
              SetField(message, absl::StrCat(field, ".seconds"), "1");
              SetField(message, absl::StrCat(field, ".nanos"), "-1");
            },
            absl::StatusCode::kInvalidArgument, absl::StrCat(field, ".nanos")});
}

inline BadInputs BadUpdateMission() {
  return BadInputs()
      .Rows(BadMissionName("mission.name"))
      .Rows(BadTimeToLive("mission.idle_time_to_live"))
      .Row({"mission.event_retention", "9",
            [](Message& message) {
              SetField(message, "mission.event_retention", "9");
              static_cast<v1::UpdateMissionRequest&>(message).mutable_update_mask()->add_paths(
                  "event_retention");
            },
            absl::StatusCode::kInvalidArgument, "mission.event_retention"})
      .Row({"update_mask", "none",
            [](Message& message) {
              static_cast<v1::UpdateMissionRequest&>(message).clear_update_mask();
            },
            absl::StatusCode::kInvalidArgument, "update_mask"})
      .ValuesBlaming("update_mask", "update_mask.paths",
                     {R"("")", R"("name")", R"("options")", R"("*")", R"("no_such")"});
}

}  // namespace plumescout::server
