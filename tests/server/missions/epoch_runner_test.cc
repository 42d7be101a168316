// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/epoch_runner.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "absl/synchronization/notification.h"
#include "core/gas/gas_maps.h"

namespace plumescout::server {
namespace epoch_runner_test {

std::shared_ptr<GasEpochs> MakeEpoch() {
  const Grid<CellState> states({0.0, 0.0, 0.1, 64, 64}, CellState::kFree);
  GasMap gas{GasOptions{}};
  gas.Add(1, {1.0, 1.0}, {5.0, 0.0});
  EXPECT_TRUE(gas.Refresh(states, 1).ok());
  EXPECT_TRUE(gas.BeginEpoch(2).ok());
  return std::make_shared<GasEpochs>(std::vector<std::shared_ptr<GasEpoch>>{gas.epoch()});
}

class EpochRunnerTest : public testing::Test {
 protected:
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

  const std::shared_ptr<GasEpochs> epoch_ = MakeEpoch();
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

TEST_F(EpochRunnerTest, EpochThatWaitsIsDroppedForTheNext) {
  Occupy(2);
  const auto next = MakeEpoch();
  EpochRunner runner(&*pool_);
  runner.Start(epoch_);
  runner.Start(next);
  release_.Notify();
  pool_.reset();
  runner.Finish();
  EXPECT_FALSE(epoch_->done());
  EXPECT_TRUE(next->done());
}

}  // namespace epoch_runner_test
}  // namespace plumescout::server
