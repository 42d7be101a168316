// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/snapshot_service.pb.h"
#include "tests/server/bad_input.h"
#include "tests/server/bad_name_input.h"

namespace plumescout::server {

inline BadInputs BadHistory() {
  return BadInputs()
      .Rows(BadMissionName("mission"))
      .ValuesBlaming("kinds[0]", "kinds", {"0", "99", "-1"})
      .Values("first_number", {"-1"})
      .Values("page_size", {"-1", "-2147483648"})
      .Values("page_token", {"\"x\"", "\"!\"", "\"MQ==\""});
}

inline BadInputs BadExport() {
  return BadInputs().Rows(BadMissionName("mission")).Values("format", {"3", "-1"});
}

inline BadInputs BadImport() {
  return BadInputs()
      .Values("start.mission_id", {"\"Attic\"", "\"-\"", "\"missions/attic\"", "\" \""})
      .Value("start.mission_id", "\"hall\"", absl::StatusCode::kAlreadyExists, "MISSION_EXISTS")
      .Values("piece.offset_bytes", {"-1", "1", "9223372036854775807"})
      .ValuesBlaming("piece.crc32", "piece.data", {"\"x\""})
      .Values("piece.crc32", {"1"})
      .Values("end.total_bytes", {"-1", "1"})
      .Values("end.sha256", {"\"x\"", "\"\""});
}

}  // namespace plumescout::server
