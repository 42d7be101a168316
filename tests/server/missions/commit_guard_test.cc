// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/commit_guard.h"

#include <gtest/gtest.h>

#include <thread>

namespace plumescout::server {
namespace commit_guard_test {

TEST(CommitGuardTest, WhoGivesUpBeforeIsToldAndNothingIsCommitted) {
  CommitGuard guard;
  EXPECT_TRUE(guard.GiveUp());
  EXPECT_FALSE(guard.Begin());
}

TEST(CommitGuardTest, WhoGivesUpAfterIsNotTold) {
  CommitGuard guard;
  EXPECT_TRUE(guard.Begin());
  EXPECT_FALSE(guard.GiveUp());
}

TEST(CommitGuardTest, WhatIsNotCommittedAfterAllCanBeGivenUp) {
  CommitGuard guard;
  EXPECT_TRUE(guard.Begin());
  EXPECT_TRUE(guard.Undo());
  EXPECT_TRUE(guard.Begin());
  EXPECT_FALSE(guard.GiveUp());
  EXPECT_FALSE(guard.Undo()) << "nobody has told the caller";
  EXPECT_FALSE(guard.Begin());
}

TEST(CommitGuardTest, NeverBothCommittedAndTold) {
  for (int i = 0; i < 200; ++i) {
    CommitGuard guard;
    bool committed = false;
    std::thread writer([&] { committed = guard.Begin(); });
    const bool told = guard.GiveUp();
    writer.join();
    EXPECT_FALSE(committed && told);
  }
}

}  // namespace commit_guard_test
}  // namespace plumescout::server
