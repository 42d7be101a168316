// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/sought_missions.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "core/types/error_reason.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace sought_missions_test {

using std::chrono::milliseconds;

constexpr SteadyTime kNow = SteadyTime() + std::chrono::hours(1);

TEST(SoughtMissionsTest, AnAnswerHoldsForAWhile) {
  SoughtMissions sought({.answer_holds = absl::Milliseconds(500)});
  EXPECT_EQ(sought.Next(), std::nullopt);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow)), reason::kRecovering);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow)), reason::kRecovering);
  EXPECT_EQ(sought.Next(), "hall");
  EXPECT_EQ(sought.Next(), std::nullopt) << "once is enough";
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow)), reason::kRecovering);
  const absl::Status damaged = absl::DataLossError("it is damaged");
  sought.Settle("hall", damaged, kNow);
  EXPECT_EQ(sought.CallFor("hall", kNow + milliseconds(499)), damaged);
  EXPECT_EQ(sought.Next(), std::nullopt);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow + milliseconds(500))), reason::kRecovering);
  EXPECT_EQ(sought.Next(), "hall") << "it may be mended";
  sought.Erase("hall");
  sought.Settle("hall", damaged, kNow);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow)), reason::kRecovering);
}

TEST(SoughtMissionsTest, WhatItIsToldIsSaidUntilThen) {
  SoughtMissions sought;
  const absl::Status elsewhere = MissionElsewhere("hall", "n2");
  sought.Tell("hall", elsewhere, kNow + milliseconds(20));
  EXPECT_EQ(sought.CallFor("hall", kNow), elsewhere);
  EXPECT_EQ(sought.CallFor("hall", kNow + milliseconds(19)), elsewhere);
  EXPECT_EQ(sought.Next(), std::nullopt);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow + milliseconds(20))), reason::kRecovering);
}

TEST(SoughtMissionsTest, WhereAMissionIsHoldsForThoseOnlyWhoWaitedForIt) {
  SoughtMissions sought({.elsewhere_holds = absl::Milliseconds(20)});
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow)), reason::kRecovering);
  EXPECT_EQ(sought.Next(), "hall");
  const absl::Status elsewhere = MissionElsewhere("hall", "n2");
  sought.Settle("hall", elsewhere, kNow);
  EXPECT_EQ(sought.CallFor("hall", kNow), elsewhere);
  EXPECT_EQ(sought.CallFor("hall", kNow + milliseconds(19)), elsewhere);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow + milliseconds(20))), reason::kRecovering)
      << "it may have moved";
}

TEST(SoughtMissionsTest, AnAnswerWaitsForWhoComesBackLate) {
  SoughtMissions sought({.answer_holds = absl::Milliseconds(500)});
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow)), reason::kRecovering);
  EXPECT_EQ(sought.Next(), "hall");
  const absl::Status elsewhere = MissionElsewhere("hall", "n2");
  sought.Settle("hall", elsewhere, kNow);
  EXPECT_EQ(sought.CallFor("hall", kNow + milliseconds(2400)), elsewhere);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow + milliseconds(2401))), reason::kRecovering)
      << "it was heard, and may not be so any more";
  EXPECT_EQ(sought.Next(), "hall");
  sought.Settle("hall", elsewhere, kNow);
  EXPECT_EQ(ErrorReason(sought.CallFor("hall", kNow + std::chrono::seconds(10))),
            reason::kRecovering);
}

TEST(SoughtMissionsTest, NamesThatCallersMakeUpAreBounded) {
  SoughtMissions sought({.answer_holds = absl::Milliseconds(500), .max_missions = 2});
  for (const char* key : {"a", "b"}) {
    EXPECT_EQ(ErrorReason(sought.CallFor(key, kNow)), reason::kRecovering);
  }
  EXPECT_EQ(ErrorReason(sought.CallFor("c", kNow)), reason::kOverloaded);
  sought.Settle("a", NotStored("a"), kNow);
  EXPECT_EQ(ErrorReason(sought.CallFor("c", kNow)), reason::kOverloaded);
  EXPECT_EQ(ErrorReason(sought.CallFor("c", kNow + milliseconds(500))), reason::kRecovering);
}

}  // namespace sought_missions_test
}  // namespace plumescout::server
