// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/audit_runner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <optional>

#include "absl/synchronization/notification.h"
#include "core/gas/gas_map.h"

namespace plumescout::server {
namespace audit_runner_test {

std::shared_ptr<const AuditInputs> Moment() {
  GasMap gas{GasOptions{}};
  gas.Add(1, {1.0, 1.0}, {5.0, 0.0});
  EXPECT_TRUE(gas.Refresh(Grid<CellState>({0.0, 0.0, 0.1, 24, 24}, CellState::kFree), 1).ok());
  return gas.MakeAudit();
}

TEST(AuditRunnerTest, GivesWhatItFoundOnce) {
  std::optional<WorkerPool> pool(std::in_place, WorkerPoolOptions{"test", 1, 1});
  AuditRunner runner(&*pool);
  EXPECT_TRUE(runner.is_free());
  EXPECT_FALSE(runner.Take().has_value());
  runner.Start({Moment()});
  EXPECT_FALSE(runner.is_free());
  pool.reset();  // having run what was queued
  const auto finding = runner.Take();
  ASSERT_TRUE(finding.has_value());
  ASSERT_TRUE(finding->ok());
  EXPECT_TRUE((*finding)->certified);
  EXPECT_TRUE(runner.is_free());
  EXPECT_FALSE(runner.Take().has_value());
}

TEST(AuditRunnerTest, GivesWhatItFoundOfEachFieldInTheirOrder) {
  std::optional<WorkerPool> pool(std::in_place, WorkerPoolOptions{"test", 1, 1});
  AuditRunner runner(&*pool);
  auto second = std::make_shared<AuditInputs>(*Moment());
  second->species = 1;
  runner.Start({Moment(), second});
  pool.reset();
  const auto first = runner.Take();
  ASSERT_TRUE(first.has_value() && first->ok());
  EXPECT_EQ((*first)->species, 0U);
  EXPECT_FALSE(runner.is_free()) << "a finding waits";
  const auto last = runner.Take();
  ASSERT_TRUE(last.has_value() && last->ok());
  EXPECT_EQ((*last)->species, 1U);
  EXPECT_TRUE((*last)->certified);
  EXPECT_TRUE(runner.is_free());
  EXPECT_FALSE(runner.Take().has_value());
  runner.Start({});
  EXPECT_TRUE(runner.is_free()) << "nothing to audit";
}

TEST(AuditRunnerTest, TellsOfEachFindingAsLongAsItLives) {
  std::optional<WorkerPool> pool(std::in_place, WorkerPoolOptions{"test", 1, 2});
  std::atomic<int> told = 0;
  AuditRunner runner(&*pool);
  runner.OnFinding([&] { ++told; });
  runner.Start({Moment(), Moment()});
  auto gone = std::make_unique<AuditRunner>(&*pool);
  absl::Notification begun, go_on;
  ASSERT_TRUE(pool->Submit([&] {
                    begun.Notify();
                    go_on.WaitForNotification();
                  })
                  .ok());
  begun.WaitForNotification();
  EXPECT_EQ(told, 2);
  gone->OnFinding([&] { told = -100; });
  gone->Start({Moment()});
  gone = nullptr;
  go_on.Notify();
  pool.reset();
  EXPECT_EQ(told, 2);
}

TEST(AuditRunnerTest, SaysWhenNothingCouldBeFound) {
  std::optional<WorkerPool> pool(std::in_place, WorkerPoolOptions{"test", 1, 1});
  AuditRunner runner(&*pool);
  auto broken = std::make_shared<AuditInputs>(*Moment());
  broken->options.prior_precision_per_ppm2 = std::nan("");
  runner.Start({broken});
  pool.reset();
  const auto finding = runner.Take();
  ASSERT_TRUE(finding.has_value());
  EXPECT_FALSE(finding->ok());
}

TEST(AuditRunnerTest, OneAtATimeAndNoneThatThePoolHasNoRoomFor) {
  absl::Notification occupied, release;
  std::optional<WorkerPool> pool(std::in_place, WorkerPoolOptions{"test", 1, 1});
  ASSERT_TRUE(pool->Submit([&] {
                    occupied.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  occupied.WaitForNotification();
  AuditRunner first(&*pool);
  AuditRunner second(&*pool);
  first.Start({Moment()});
  second.Start({Moment()});
  EXPECT_FALSE(first.is_free());
  EXPECT_TRUE(second.is_free()) << "passed over";
  EXPECT_FALSE(first.Take().has_value()) << "it waits";
  release.Notify();
  pool.reset();
  EXPECT_TRUE(first.Take().has_value());
}

TEST(AuditRunnerTest, AnAuditThatWaitsIsDroppedWithItsRunner) {
  absl::Notification occupied, release;
  const auto moment = Moment();
  std::optional<WorkerPool> pool(std::in_place, WorkerPoolOptions{"test", 1, 1});
  ASSERT_TRUE(pool->Submit([&] {
                    occupied.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  occupied.WaitForNotification();
  {
    AuditRunner runner(&*pool);
    runner.Start({moment});
  }
  release.Notify();
  pool.reset();
  EXPECT_EQ(moment.use_count(), 1);
}

TEST(AuditRunnerTest, NothingIsAuditedWithoutAPool) {
  AuditRunner runner(nullptr);
  EXPECT_FALSE(runner.is_free());
  runner.Start({Moment()});
  EXPECT_FALSE(runner.Take().has_value());
}

}  // namespace audit_runner_test
}  // namespace plumescout::server
