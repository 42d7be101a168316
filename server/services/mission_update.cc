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
constexpr char kEventRetention[] = "event_retention";
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

absl::StatusOr<EventRetention> EventRetentionFromProto(v1::EventRetention proto,
                                                       absl::string_view field) {
  switch (proto) {
    case v1::EVENT_RETENTION_UNSPECIFIED:
    case v1::EVENT_RETENTION_ALL:
      return EventRetention::kAll;
    case v1::EVENT_RETENTION_SINCE_SNAPSHOT:
      return EventRetention::kSinceSnapshot;
    default:
      return FieldError(field, proto, "is unknown");
  }
}

v1::EventRetention EventRetentionToProto(EventRetention retention) {
  return retention == EventRetention::kAll ? v1::EVENT_RETENTION_ALL
                                           : v1::EVENT_RETENTION_SINCE_SNAPSHOT;
}

absl::StatusOr<MissionUpdate> MissionUpdateFromProto(const v1::UpdateMissionRequest& request) {
  const v1::Mission& mission = request.mission();
  MissionUpdate update;
  PLUMESCOUT_ASSIGN_OR_RETURN(update.mission, ParseMissionName("mission.name", mission.name()));
  if (request.update_mask().paths().empty()) {
    return FieldError("update_mask", "must name idle_time_to_live or event_retention");
  }
  for (const std::string& path : request.update_mask().paths()) {
    if (path == kIdleTimeToLive) {
      update.idle_time_to_live = absl::InfiniteDuration();
    } else if (path == kEventRetention) {
      PLUMESCOUT_ASSIGN_OR_RETURN(
          update.event_retention,
          EventRetentionFromProto(mission.event_retention(), "mission.event_retention"));
    } else {
      return FieldError("update_mask", path,
                        "cannot change; idle_time_to_live and event_retention can");
    }
  }
  if (update.idle_time_to_live.has_value() && mission.has_idle_time_to_live()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        update.idle_time_to_live,
        IdleTimeToLiveFromProto(mission.idle_time_to_live(), "mission.idle_time_to_live"));
  }
  return update;
}

}  // namespace plumescout::server
