// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/thread_priority.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <thread>

namespace plumescout::server {
namespace thread_priority_test {

int Niceness() { return getpriority(PRIO_PROCESS, 0); }

TEST(ThreadPriorityTest, YieldsOfOneThread) {
  const int before = Niceness();
  int yielding = before;
  std::thread([&] {
    YieldCpuToOthers();
    yielding = Niceness();
  }).join();
  EXPECT_EQ(yielding, std::min(before + 10, 19));
  EXPECT_EQ(Niceness(), before);
}

TEST(ThreadPriorityTest, NobodyYieldsMoreThanThereIs) {
  int yielding = 0;
  std::thread([&] {
    for (int i = 0; i < 3; ++i) YieldCpuToOthers();
    yielding = Niceness();
  }).join();
  EXPECT_EQ(yielding, 19);
}

}  // namespace thread_priority_test
}  // namespace plumescout::server
