// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/side_work.h"

#include "gtest/gtest.h"

namespace plumescout::server {
namespace side_work_test {

TEST(SideWork, IsDoneOnceByThePoolOrByWhoNeedsIt) {
  WorkerPool pool(WorkerPoolOptions{"test", 1, 1});
  for (WorkerPool* each : {&pool, static_cast<WorkerPool*>(nullptr)}) {
    SideWork work(each);
    int done = 0;
    work.Finish();
    work.Start([&done] { ++done; });
    work.Finish();
    work.Finish();
    EXPECT_EQ(done, 1);
  }
}

TEST(SideWork, WhatIsNotWantedAnyMoreIsNotDone) {
  int first = 0;
  int second = 0;
  {
    SideWork work(nullptr);
    work.Start([&first] { ++first; });
    work.Start([&second] { ++second; });
    work.Finish();
    work.Start([&second] { ++second; });
  }
  EXPECT_EQ(first, 0);
  EXPECT_EQ(second, 1);
}

}  // namespace side_work_test
}  // namespace plumescout::server
