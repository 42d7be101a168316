// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "core/types/ids.h"
#include "google/protobuf/duration.pb.h"
#include "plumescout/v1/mission_service.pb.h"
#include "server/missions/mission_standing.h"

namespace plumescout::server {

// A mission that nobody calls for so long is deleted, 1 s to 10 years.
absl::StatusOr<absl::Duration> IdleTimeToLiveFromProto(const google::protobuf::Duration& proto,
                                                       absl::string_view field);
// Infinite: nothing is set.
void SetIdleTimeToLive(absl::Duration duration, v1::Mission& mission);

// Unset: all.
absl::StatusOr<EventRetention> EventRetentionFromProto(v1::EventRetention proto,
                                                       absl::string_view field);
v1::EventRetention EventRetentionToProto(EventRetention retention);

// What an UpdateMissionRequest asks for; what is absent stays as it is.
struct MissionUpdate {
  MissionId mission;
  std::optional<absl::Duration> idle_time_to_live = std::nullopt;  // infinite: never
  std::optional<EventRetention> event_retention = std::nullopt;
};

// Refuses masks of anything else that a mission has.
absl::StatusOr<MissionUpdate> MissionUpdateFromProto(const v1::UpdateMissionRequest& request);

}  // namespace plumescout::server
