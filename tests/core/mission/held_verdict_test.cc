// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/held_verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout {
namespace held_verdict_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

ObjectiveOptions Of(ObjectiveKind kind, double hold_s = 10.0) {
  return {.kind = kind, .threshold_ppm = 10.0, .hold_s = hold_s};
}

class Verdicts {
 public:
  explicit Verdicts(const ObjectiveOptions& objective) : objective_(objective) {}

  ObjectiveState At(double time_s, ObjectiveState state, bool nothing_left_to_do = false) {
    return held.Take(state, objective_, Time(time_s), nothing_left_to_do);
  }
  bool IsSettledAt(double time_s) const { return held.IsSettled(objective_, Time(time_s)); }

  HeldVerdict held;

 private:
  static std::int64_t Time(double time_s) { return std::llround(time_s * kSecond_ns); }

  ObjectiveOptions objective_;
};

TEST(HeldVerdict, IsOneOnceItHasHeld) {
  Verdicts clean(Of(ObjectiveKind::kConfirmClean));
  EXPECT_EQ(clean.At(5.0, ObjectiveState::kMet), ObjectiveState::kPursued);
  EXPECT_EQ(clean.held.pending(), ObjectiveState::kMet);
  EXPECT_EQ(clean.At(14.9, ObjectiveState::kMet), ObjectiveState::kPursued);
  EXPECT_FALSE(clean.IsSettledAt(14.9));
  EXPECT_EQ(clean.At(15.0, ObjectiveState::kMet), ObjectiveState::kMet);
  EXPECT_TRUE(clean.IsSettledAt(15.0));
}

TEST(HeldVerdict, CountsFromAnewAfterADoubt) {
  Verdicts clean(Of(ObjectiveKind::kConfirmClean));
  clean.At(5.0, ObjectiveState::kMet);
  EXPECT_EQ(clean.At(9.0, ObjectiveState::kPursued), ObjectiveState::kPursued);
  EXPECT_EQ(clean.held.pending(), ObjectiveState::kPursued);
  EXPECT_TRUE(clean.IsSettledAt(9.0)) << "there is nothing to take back";
  clean.At(10.0, ObjectiveState::kMet);
  EXPECT_EQ(clean.At(19.0, ObjectiveState::kMet), ObjectiveState::kPursued);
  EXPECT_EQ(clean.At(20.0, ObjectiveState::kMet), ObjectiveState::kMet);
}

TEST(HeldVerdict, WhatOneCellShowsIsSoAtOnce) {
  Verdicts clean(Of(ObjectiveKind::kConfirmClean));
  EXPECT_EQ(clean.At(5.0, ObjectiveState::kRefuted), ObjectiveState::kRefuted);
  Verdicts sources(Of(ObjectiveKind::kFindSources));
  EXPECT_EQ(sources.At(5.0, ObjectiveState::kRefuted), ObjectiveState::kPursued)
      << "that there is no source rests on all cells";
  EXPECT_EQ(sources.At(15.0, ObjectiveState::kRefuted), ObjectiveState::kRefuted);
}

TEST(HeldVerdict, OfRobotsThatHaveNothingLeftToDoIsToldAtOnceAndTakenBack) {
  Verdicts clean(Of(ObjectiveKind::kConfirmClean));
  EXPECT_EQ(clean.At(5.0, ObjectiveState::kMet, true), ObjectiveState::kMet);
  EXPECT_FALSE(clean.IsSettledAt(5.0));
  EXPECT_EQ(clean.At(9.0, ObjectiveState::kPursued, true), ObjectiveState::kPursued);
}

TEST(HeldVerdict, NeedNotHoldIfItIsNotAskedFor) {
  Verdicts clean(Of(ObjectiveKind::kConfirmClean, 0.0));
  EXPECT_EQ(clean.At(5.0, ObjectiveState::kMet), ObjectiveState::kMet);
  EXPECT_TRUE(clean.held.empty()) << "missions of before have the hash that they had";
}

}  // namespace held_verdict_test
}  // namespace plumescout
