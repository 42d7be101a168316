// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "core/types/ids.h"
#include "server/missions/mission_standing.h"

namespace plumescout::server {

// What is kept of a mission beside its events.
struct StandingRecord {
  MissionState state = MissionState::kRunning;
  absl::Duration idle_time_to_live = absl::InfiniteDuration();
  std::map<RobotId, std::int64_t> released_leases = {};  // tokens that were given up
  EventRetention event_retention = EventRetention::kAll;

  friend bool operator==(const StandingRecord&, const StandingRecord&) = default;
};

std::string EncodeStanding(const StandingRecord& record);
// Of nothing: the record of a new mission. kDataLoss if `bytes` are none; kFailedPrecondition,
// naming the version, if a newer program wrote them.
absl::StatusOr<StandingRecord> DecodeStanding(absl::string_view bytes);

}  // namespace plumescout::server
