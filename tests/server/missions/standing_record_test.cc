// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/standing_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumescout::server {
namespace standing_record_test {

TEST(StandingRecordTest, SurvivesTheRoundTrip) {
  for (const MissionState state :
       {MissionState::kRunning, MissionState::kPaused, MissionState::kFinished}) {
    const StandingRecord record{state,
                                absl::Milliseconds(1500),
                                {{"r1", 1LL << 52}, {"r2", 7}},
                                EventRetention::kSinceSnapshot};
    const auto back = DecodeStanding(EncodeStanding(record));
    ASSERT_TRUE(back.ok()) << back.status();
    EXPECT_EQ(*back, record);
  }
}

TEST(StandingRecordTest, NothingIsTheStandingOfANewMission) {
  EXPECT_EQ(DecodeStanding("").value(), StandingRecord{});
  EXPECT_EQ(DecodeStanding(EncodeStanding({})).value(), StandingRecord{});
}

TEST(StandingRecordTest, WhatIsNoneIsDataLoss) {
  for (const char* bytes : {"paused", "[]", "{}", R"({"version":"1"})", R"({"version":1})",
                            R"({"version":1,"state":"asleep"})",
                            R"({"version":1,"state":"paused","idle_time_to_live_ns":"long"})",
                            R"({"version":1,"state":"paused","event_retention":"none"})",
                            R"({"version":1,"state":"paused","released_leases":[1]})",
                            R"({"version":1,"state":"paused","released_leases":{"r1":"x"}})"}) {
    EXPECT_TRUE(absl::IsDataLoss(DecodeStanding(bytes).status())) << bytes;
  }
}

TEST(StandingRecordTest, ANewerVersionIsRefusedByName) {
  const absl::Status refused = DecodeStanding(R"({"version":2,"state":"asleep"})").status();
  EXPECT_TRUE(absl::IsFailedPrecondition(refused));
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("version 2"));
}

}  // namespace standing_record_test
}  // namespace plumescout::server
