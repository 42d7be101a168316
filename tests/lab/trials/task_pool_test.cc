// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/task_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/barrier.h"

namespace plumescout::lab {
namespace task_pool_test {

TEST(TaskPool, DoesEveryTaskOnce) {
  for (const int jobs : {1, 2, 5, 100}) {
    std::vector<std::atomic<int>> done(17);
    ASSERT_TRUE(RunTasks(done.size(), jobs, [&](std::size_t i) {
                  ++done[i];
                  return absl::OkStatus();
                }).ok());
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
  }
}

TEST(TaskPool, WorksOnAsManyAsThereAreJobs) {
  absl::Barrier both(2);  // would wait for ever if tasks came one by one
  EXPECT_TRUE(RunTasks(2, 2, [&](std::size_t) {
                both.Block();
                return absl::OkStatus();
              }).ok());
}

TEST(TaskPool, StopsAtAFailureAndTellsTheFirst) {
  std::atomic<int> begun = 0;
  const absl::Status status = RunTasks(1000, 2, [&](std::size_t i) {
    ++begun;
    return i >= 10 ? absl::InternalError(absl::StrCat("task ", i)) : absl::OkStatus();
  });
  EXPECT_EQ(status.message(), "task 10");
  EXPECT_LE(begun, 13);  // what was under way may end
}

TEST(TaskPool, TellsItsProgressUpToTheEnd) {
  std::vector<double> shares;
  ASSERT_TRUE(RunTasks(
                  4, 2, [](std::size_t) { return absl::OkStatus(); },
                  [&](double share) { shares.push_back(share); })
                  .ok());
  EXPECT_EQ(shares, (std::vector{0.25, 0.5, 0.75, 1.0}));
}

TEST(TaskPool, HasNothingToDoWithoutTasks) {
  EXPECT_TRUE(RunTasks(0, 3, [](std::size_t) { return absl::InternalError("no"); }).ok());
}

}  // namespace task_pool_test
}  // namespace plumescout::lab
