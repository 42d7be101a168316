// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_update.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "proto/convert/status.h"

namespace plumescout::server {
namespace mission_update_test {

// The field that a refusal is about.
std::string Blamed(const absl::Status& refused) {
  const std::vector<FieldViolation> violations = FieldViolations(refused);
  return absl::IsInvalidArgument(refused) && violations.size() == 1 ? violations[0].field : "";
}

v1::UpdateMissionRequest Request(std::int64_t seconds) {
  v1::UpdateMissionRequest request;
  request.mutable_mission()->set_name("missions/hall");
  request.mutable_mission()->mutable_idle_time_to_live()->set_seconds(seconds);
  request.mutable_update_mask()->add_paths("idle_time_to_live");
  return request;
}

TEST(MissionUpdateTest, TheTimeToLiveIsRead) {
  v1::UpdateMissionRequest request = Request(60);
  request.mutable_mission()->mutable_idle_time_to_live()->set_nanos(500'000'000);
  const auto update = MissionUpdateFromProto(request);
  ASSERT_TRUE(update.ok()) << update.status();
  EXPECT_EQ(update->mission, "hall");
  EXPECT_EQ(update->idle_time_to_live, absl::Milliseconds(60'500));
}

TEST(MissionUpdateTest, AnAbsentTimeToLiveIsForEver) {
  v1::UpdateMissionRequest request = Request(60);
  request.mutable_mission()->clear_idle_time_to_live();
  EXPECT_EQ(MissionUpdateFromProto(request)->idle_time_to_live, absl::InfiniteDuration());
}

TEST(MissionUpdateTest, MasksOfAnythingElseAreRefused) {
  v1::UpdateMissionRequest request = Request(60);
  request.mutable_update_mask()->add_paths("options");
  EXPECT_EQ(Blamed(MissionUpdateFromProto(request).status()), "update_mask");
  request.clear_update_mask();
  EXPECT_EQ(Blamed(MissionUpdateFromProto(request).status()), "update_mask");
}

TEST(MissionUpdateTest, TimesOutOfRangeAreRefused) {
  for (const std::int64_t seconds : {-1L, 0L, 315'360'001L}) {
    EXPECT_EQ(Blamed(MissionUpdateFromProto(Request(seconds)).status()),
              "mission.idle_time_to_live.seconds");
  }
}

TEST(MissionUpdateTest, ATimeToLiveSurvivesTheRoundTrip) {
  v1::Mission mission;
  SetIdleTimeToLive(absl::InfiniteDuration(), mission);
  EXPECT_FALSE(mission.has_idle_time_to_live());
  SetIdleTimeToLive(absl::Milliseconds(90'250), mission);
  EXPECT_EQ(IdleTimeToLiveFromProto(mission.idle_time_to_live(), "x").value(),
            absl::Milliseconds(90'250));
}

TEST(MissionUpdateTest, TheRetentionOfEventsIsRead) {
  v1::UpdateMissionRequest request;
  request.mutable_mission()->set_name("missions/hall");
  request.mutable_update_mask()->add_paths("event_retention");
  for (const EventRetention retention : {EventRetention::kAll, EventRetention::kSinceSnapshot}) {
    request.mutable_mission()->set_event_retention(EventRetentionToProto(retention));
    const auto update = MissionUpdateFromProto(request);
    ASSERT_TRUE(update.ok()) << update.status();
    EXPECT_EQ(update->event_retention, retention);
    EXPECT_FALSE(update->idle_time_to_live.has_value()) << "it is not in the mask";
  }
  request.mutable_mission()->clear_event_retention();
  EXPECT_EQ(MissionUpdateFromProto(request)->event_retention, EventRetention::kAll);
  request.mutable_mission()->set_event_retention(static_cast<v1::EventRetention>(9));
  EXPECT_EQ(Blamed(MissionUpdateFromProto(request).status()), "mission.event_retention");
}

}  // namespace mission_update_test
}  // namespace plumescout::server
