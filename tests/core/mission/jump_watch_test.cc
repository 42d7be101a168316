// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/jump_watch.h"

#include "gtest/gtest.h"

namespace plumescout {
namespace jump_watch_test {

constexpr ScanFit kFits{100, 0, 0};
constexpr ScanFit kContradicts{50, 30, 20};
constexpr ScanFit kInTheWay{50, 50, 0};
constexpr ScanFit kDoorOpened{50, 0, 50};
constexpr ScanFit kTellsNothing{10, 5, 4};

class JumpWatchTest : public testing::Test {
 protected:
  JumpVerdict Note(const ScanFit& fit) {
    ++number_;
    return watch_.Note("a", number_, number_ * 100'000'000, fit);
  }

  JumpWatch watch_;
  std::int64_t number_ = 0;
};

TEST_F(JumpWatchTest, FourOfFiveScansMakeSuspect) {
  for (int i = 0; i < 10; ++i) EXPECT_EQ(Note(kFits), JumpVerdict::kTrusted);
  EXPECT_EQ(Note(kContradicts), JumpVerdict::kTrusted);
  EXPECT_EQ(Note(kFits), JumpVerdict::kTrusted);
  EXPECT_EQ(Note(kContradicts), JumpVerdict::kTrusted);
  EXPECT_EQ(Note(kTellsNothing), JumpVerdict::kTrusted);
  EXPECT_EQ(Note(kContradicts), JumpVerdict::kTrusted);
  EXPECT_EQ(Note(kContradicts), JumpVerdict::kTurnsSuspect);
  EXPECT_EQ(watch_.DoubtfulFrom("a"), 11) << "the first after the ten that fitted";
  EXPECT_TRUE(watch_.IsSuspect("a"));
  EXPECT_FALSE(watch_.IsSuspect("b"));
  EXPECT_EQ(Note(kTellsNothing), JumpVerdict::kSuspect);
}

TEST_F(JumpWatchTest, WhatIsOnOneSideAloneIsTheWorldThatChanged) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(Note(kInTheWay), JumpVerdict::kTrusted);
    EXPECT_EQ(Note(kDoorOpened), JumpVerdict::kTrusted);
  }
}

TEST_F(JumpWatchTest, ThreeSecondsThatFitEndIt) {
  for (int i = 0; i < 4; ++i) Note(kContradicts);
  ASSERT_TRUE(watch_.IsSuspect("a"));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(Note(kFits), JumpVerdict::kSuspect);
  EXPECT_EQ(Note(kContradicts), JumpVerdict::kSuspect);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(Note(kFits), JumpVerdict::kSuspect);
  EXPECT_EQ(Note(kFits), JumpVerdict::kFitsAgain);
  EXPECT_EQ(Note(kFits), JumpVerdict::kTrusted);
}

TEST_F(JumpWatchTest, TrustBeginsAnew) {
  for (int i = 0; i < 4; ++i) Note(kContradicts);
  watch_.Trust("a", number_ + 1);
  EXPECT_FALSE(watch_.IsSuspect("a"));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Note(kContradicts), JumpVerdict::kTrusted);
  EXPECT_EQ(Note(kContradicts), JumpVerdict::kTurnsSuspect);
  EXPECT_EQ(watch_.DoubtfulFrom("a"), 5) << "not what came before it was trusted";
}

}  // namespace jump_watch_test
}  // namespace plumescout
