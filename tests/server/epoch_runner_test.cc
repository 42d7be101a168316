// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/epoch_runner.h"

#include <gtest/gtest.h>

#include <optional>

#include "absl/synchronization/notification.h"
#include "core/gas/gas_map.h"

namespace plumescout::server {
namespace {

class EpochRunnerTest : public testing::Test {
 protected:
  EpochRunnerTest() {
    const Grid<CellState> states({0.0, 0.0, 0.1, 64, 64}, CellState::kFree);
    gas_.Add(1, {1.0, 1.0}, {5.0, 0.0});
    EXPECT_TRUE(gas_.Refresh(states, 1).ok());
    epoch_ = gas_.BeginEpoch(2);
  }
  // Until Release the pool's only thread does nothing else.
  void Occupy(int max_queued) {
    pool_.emplace(WorkerPoolOptions{"test", 1, max_queued});
    ASSERT_TRUE(pool_
                    ->Submit([this] {
                      occupied_.Notify();
                      release_.WaitForNotification();
                    })
                    .ok());
    occupied_.WaitForNotification();
  }

  GasMap gas_{GasOptions{}};
  std::shared_ptr<GasEpoch> epoch_;
  absl::Notification occupied_;
  absl::Notification release_;
  std::optional<WorkerPool> pool_;  // goes first: its threads use the above
};

TEST_F(EpochRunnerTest, FinishWaitsForThePool) {
  pool_.emplace(WorkerPoolOptions{"test", 1, 1});
  EpochRunner runner(&*pool_);
  runner.Start(epoch_);
  runner.Finish();
  EXPECT_TRUE(epoch_->done());
}

TEST_F(EpochRunnerTest, FinishComputesWhatThePoolHasNotComeTo) {
  Occupy(1);
  EpochRunner runner(&*pool_);
  runner.Start(epoch_);
  runner.Finish();
  EXPECT_TRUE(epoch_->done());
  release_.Notify();
}

TEST_F(EpochRunnerTest, FinishComputesWhatThePoolRefused) {
  Occupy(1);
  ASSERT_TRUE(pool_->Submit([] {}).ok());
  EpochRunner runner(&*pool_);
  runner.Start(epoch_);
  runner.Finish();
  EXPECT_TRUE(epoch_->done());
  release_.Notify();
}

TEST_F(EpochRunnerTest, FinishComputesWithoutAPool) {
  EpochRunner runner(nullptr);
  runner.Start(epoch_);
  EXPECT_FALSE(epoch_->done());
  runner.Finish();
  EXPECT_TRUE(epoch_->done());
}

TEST_F(EpochRunnerTest, FinishOfNothingReturns) {
  EpochRunner runner(nullptr);
  runner.Finish();
  runner.Start(epoch_);
  runner.Finish();
  runner.Finish();
}

TEST_F(EpochRunnerTest, EpochThatWaitsIsDroppedWithItsRunner) {
  Occupy(1);
  {
    EpochRunner runner(&*pool_);
    runner.Start(epoch_);
  }
  release_.Notify();
  pool_.reset();  // having run what was queued
  EXPECT_FALSE(epoch_->done());
}

}  // namespace
}  // namespace plumescout::server
