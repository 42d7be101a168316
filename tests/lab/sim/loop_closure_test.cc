// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/loop_closure.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace loop_closure_test {

constexpr std::int64_t kTick_ns = 100'000'000;

Pose2 At(int tick) { return {0.1 * tick, 0.0, 0.0}; }

// Whether a loop is closed at this tick of 0.1 s.
bool Pass(LoopClosure& closure, int tick) {
  return closure.Pass(0.1 * tick, tick * kTick_ns, At(tick));
}

TEST(LoopClosure, NeverComesUnlessAskedFor) {
  LoopClosure closure(std::nullopt);
  for (int tick = 1; tick < 1000; ++tick) EXPECT_FALSE(Pass(closure, tick));
  EXPECT_FALSE(closure.TakeCorrection().has_value());
}

TEST(LoopClosure, TellsTheWaySinceTheLastOne) {
  LoopClosure closure(5.0);
  for (int tick = 1; tick < 50; ++tick) EXPECT_FALSE(Pass(closure, tick));
  EXPECT_FALSE(closure.TakeCorrection().has_value());
  EXPECT_TRUE(Pass(closure, 50));
  const auto first = closure.TakeCorrection();
  ASSERT_TRUE(first.has_value());
  std::vector<PoseAnchor> expected;
  for (const int tick : {1, 11, 21, 31, 41, 50}) expected.push_back({tick * kTick_ns, At(tick)});
  EXPECT_EQ(first->anchors, expected);
  EXPECT_FALSE(closure.TakeCorrection().has_value()) << "once";

  for (int tick = 51; tick <= 100; ++tick) EXPECT_EQ(Pass(closure, tick), tick == 100);
  const auto second = closure.TakeCorrection();
  ASSERT_TRUE(second.has_value());
  ASSERT_EQ(second->anchors.size(), 6u);
  EXPECT_EQ(second->anchors.front(), first->anchors.back()) << "what was before stays";
  EXPECT_EQ(second->anchors.back().sample_time_ns, 100 * kTick_ns);
}

TEST(LoopClosure, WhatWasNotTakenIsToldWithTheNext) {
  LoopClosure closure(5.0);
  for (int tick = 1; tick <= 104; ++tick) Pass(closure, tick);
  const auto both = closure.TakeCorrection();
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both->anchors.front().sample_time_ns, kTick_ns);
  EXPECT_EQ(both->anchors.back().sample_time_ns, 100 * kTick_ns);
  for (int tick = 105; tick <= 150; ++tick) Pass(closure, tick);
  EXPECT_EQ(closure.TakeCorrection().value().anchors.front(), both->anchors.back());
}

}  // namespace loop_closure_test
}  // namespace plumescout::lab
