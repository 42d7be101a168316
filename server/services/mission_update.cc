// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_update.h"

#include <cstdint>
#include <string>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"

namespace plumescout::server {
namespace {

constexpr char kIdleTimeToLive[] = "idle_time_to_live";
constexpr std::int64_t kMaxIdle_s = 315'360'000;  // ten years

}  // namespace

absl::StatusOr<absl::Duration> IdleTimeToLiveFromProto(const google::protobuf::Duration& proto,
                                                       absl::string_view field) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(Join(field, "seconds"), proto.seconds(), 1, kMaxIdle_s));
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(Join(field, "nanos"), proto.nanos(), 0, 999'999'999));
  return absl::Seconds(proto.seconds()) + absl::Nanoseconds(proto.nanos());
}

void SetIdleTimeToLive(absl::Duration duration, v1::Mission& mission) {
  if (duration == absl::InfiniteDuration()) return;
  google::protobuf::Duration& proto = *mission.mutable_idle_time_to_live();
  proto.set_seconds(absl::IDivDuration(duration, absl::Seconds(1), &duration));
  proto.set_nanos(static_cast<std::int32_t>(absl::ToInt64Nanoseconds(duration)));
}

absl::StatusOr<MissionUpdate> MissionUpdateFromProto(const v1::UpdateMissionRequest& request) {
  const v1::Mission& mission = request.mission();
  MissionUpdate update{.mission = {}, .idle_time_to_live = absl::InfiniteDuration()};
  PLUMESCOUT_ASSIGN_OR_RETURN(update.mission, ParseMissionName("mission.name", mission.name()));
  if (request.update_mask().paths().empty()) {
    return FieldError("update_mask", "must name idle_time_to_live");
  }
  for (const std::string& path : request.update_mask().paths()) {
    if (path != kIdleTimeToLive) {
      return FieldError("update_mask", path, "cannot change; idle_time_to_live can");
    }
  }
  if (mission.has_idle_time_to_live()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        update.idle_time_to_live,
        IdleTimeToLiveFromProto(mission.idle_time_to_live(), "mission.idle_time_to_live"));
  }
  return update;
}

}  // namespace plumescout::server
