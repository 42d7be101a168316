// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/worker_pool.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>

#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"

namespace plumescout::server {
namespace worker_pool_test {

TEST(WorkerPoolTest, RunsWhatItIsGivenBeforeItGoes) {
  std::atomic<int> runs = 0;
  {
    WorkerPool pool({"test", 2, 100});
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(pool.Submit([&] { ++runs; }).ok());
  }
  EXPECT_EQ(runs, 100);
}

TEST(WorkerPoolTest, FullQueueRefusesAndSaysWhenToRetry) {
  absl::Notification started;
  absl::Notification release;
  WorkerPool pool({"test", 1, 1});
  ASSERT_TRUE(pool.Submit([&] {
                    started.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  started.WaitForNotification();
  EXPECT_TRUE(pool.Submit([] {}).ok());
  const absl::Status refused = pool.Submit([] {});
  EXPECT_TRUE(absl::IsResourceExhausted(refused));
  EXPECT_TRUE(RetryAfter_ns(refused).has_value());
  const PoolLoad load = pool.load();
  EXPECT_EQ(load.name, "test");
  EXPECT_EQ(load.threads, 1);
  EXPECT_EQ(load.busy_threads, 1);
  EXPECT_EQ(load.queued, 1);
  EXPECT_EQ(load.max_queued, 1);
  EXPECT_EQ(load.refused, 1);
  release.Notify();
}

TEST(WorkerPoolTest, ThreadsRunSideBySide) {
  absl::Notification first;
  absl::Notification second;
  WorkerPool pool({"test", 2, 10});
  ASSERT_TRUE(pool.Submit([&] { second.WaitForNotification(); }).ok());
  ASSERT_TRUE(pool.Submit([&] { first.Notify(); }).ok());
  first.WaitForNotification();  // would hang if the first task held the only thread
  second.Notify();
}

TEST(WorkerPoolTest, YieldsTheCpuIfItIsToldTo) {
  const auto niceness_in = [](bool yields) {
    int niceness = 0;
    {
      WorkerPool pool({"test", 1, 1, yields});
      EXPECT_TRUE(pool.Submit([&] { niceness = getpriority(PRIO_PROCESS, 0); }).ok());
    }
    return niceness;
  };
  EXPECT_EQ(niceness_in(false), getpriority(PRIO_PROCESS, 0));
  constexpr int kNicest = 19;
  const int usual = niceness_in(false);
  EXPECT_TRUE(niceness_in(true) > usual || usual == kNicest);
}

}  // namespace worker_pool_test
}  // namespace plumescout::server
