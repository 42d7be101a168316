// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace mission_host_test {

constexpr std::int64_t kLease = 7;

// Returns once every command posted before has run.
void Settle(MissionHost& host) {
  absl::Notification done;
  ASSERT_TRUE(host.Post([&](MissionWriter&) { done.Notify(); }).ok());
  done.WaitForNotification();
}

void AddRobot(MissionHost& host) {
  ASSERT_TRUE(host.Post([](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
                  })
                  .ok());
}

void PostGas(MissionHost& host, std::int64_t first, std::int64_t last) {
  ASSERT_TRUE(host.Post([first, last](MissionWriter& writer) {
                    EXPECT_TRUE(
                        writer.conduct().Ingest("r1", kLease, GasBatch(first, last)).status.ok());
                  })
                  .ok());
}

TEST(MissionHostTest, CommandsRunInTheOrderInWhichTheyCame) {
  MissionHost host(HostParts(), {});
  std::vector<int> order;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(host.Post([&order, i](MissionWriter&) { order.push_back(i); }).ok());
  }
  Settle(host);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

TEST(MissionHostTest, WaiterIsServedWhenTheLogArrives) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  absl::Notification served;
  std::int64_t revision = 0;
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 2}},
                               [&](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
                                 revision = belief.value()->revision;
                                 served.Notify();
                               })
                  .ok());
  PostGas(host, 1, 2);
  served.WaitForNotification();
  EXPECT_EQ(revision, 4);  // registration, two readings, refresh
}

TEST(MissionHostTest, WaiterIsDroppedAtItsDeadlineThoughNothingHappens) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  absl::Notification dropped;
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 2},
                                .deadline = SteadyNow() + std::chrono::milliseconds(20)},
                               [&](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
                                 EXPECT_TRUE(absl::IsDeadlineExceeded(belief.status()));
                                 dropped.Notify();
                               })
                  .ok());
  dropped.WaitForNotification();
}

TEST(MissionHostTest, SubscriberGetsTheBeliefAtOnceAndThenTheNewest) {
  HostOptions options;
  options.publish_period = absl::ZeroDuration();
  absl::Notification seen;
  std::vector<std::int64_t> revisions;  // outlives the host, whose thread still reads it
  MissionHost host(HostParts(), options);
  AddRobot(host);
  ASSERT_TRUE(host.Subscribe([&](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
                    if (!belief.ok()) return false;
                    revisions.push_back((*belief)->revision);
                    if (revisions.back() == 4) seen.Notify();
                    return revisions.back() < 4;
                  })
                  .ok());
  Settle(host);
  PostGas(host, 1, 3);
  seen.WaitForNotification();
  EXPECT_EQ(revisions.front(), 1);
  EXPECT_EQ(revisions.back(), 4);
}

// In no test does sample time go on far enough for a refresh of its own accord.
TEST(MissionHostTest, ReadingThatNothingFollowsReachesWhoeverWatches) {
  HostOptions options;
  options.publish_period = absl::Hours(1);
  options.gas_wait = absl::Milliseconds(5);
  absl::Notification seen;
  MissionHost host(HostParts(), options);
  AddRobot(host);
  ASSERT_TRUE(host.Subscribe([&](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
                    if (!belief.ok() || (*belief)->posterior_time_ns == 0) return belief.ok();
                    seen.Notify();
                    return false;
                  })
                  .ok());
  PostGas(host, 1, 3);
  seen.WaitForNotification();
  EXPECT_EQ(host.gas_timings().staleness.samples, 1);
}

TEST(MissionHostTest, NobodyWatchingTheClockAddsNoEvent) {
  HostOptions options;
  options.publish_period = absl::ZeroDuration();
  options.gas_wait = absl::ZeroDuration();
  MissionHost host(HostParts(), options);
  AddRobot(host);
  PostGas(host, 1, 3);
  Settle(host);
  Settle(host);
  EXPECT_EQ(host.summary().revision, 4);
}

TEST(MissionHostTest, StopLeavesAnEpochBehind) {
  absl::Notification occupied;
  absl::Notification release;
  WorkerPool pool({"epoch", 1, 8});
  ASSERT_TRUE(pool.Submit([&] {
                    occupied.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  occupied.WaitForNotification();
  {
    MissionHost::Parts parts = HostParts();
    parts.mission = std::make_unique<Mission>(support::FastAgeing());
    parts.epoch_pool = &pool;
    MissionHost host(std::move(parts), {});
    AddRobot(host);
    ASSERT_TRUE(host.Post([](MissionWriter& writer) {
                      auto log = RoomRunBatch();
                      for (std::size_t i = 0; writer.mission().epoch() == nullptr; ++i) {
                        ASSERT_LT(i, log.size());
                        writer.conduct().Ingest("r1", kLease, {log[i]});
                      }
                    })
                    .ok());
    host.Stop(absl::NotFoundError("deleted"));
  }
  release.Notify();
}

TEST(MissionHostTest, QueueRefusesWhatItHasNoRoomFor) {
  HostOptions options;
  options.max_queued_observations = 10;
  MissionHost host(HostParts(), options);
  EXPECT_TRUE(host.Reserve(7).ok());
  EXPECT_TRUE(absl::IsResourceExhausted(host.Reserve(4)));
  EXPECT_TRUE(host.Reserve(3).ok());
  host.Release(7);
  EXPECT_TRUE(host.Reserve(7).ok());
}

TEST(MissionHostTest, TooManyCommandsAreRefused) {
  HostOptions options;
  options.max_queued_commands = 1;
  MissionHost host(HostParts(), options);
  absl::Notification started;
  absl::Notification release;
  ASSERT_TRUE(host.Post([&](MissionWriter&) {
                    started.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  started.WaitForNotification();
  EXPECT_TRUE(host.Post([](MissionWriter&) {}).ok());
  EXPECT_TRUE(absl::IsResourceExhausted(host.Post([](MissionWriter&) {})));
  release.Notify();
}

TEST(MissionHostTest, StopRunsWhatIsQueuedAndFailsWhoWaits) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  std::vector<absl::StatusCode> ends;
  const auto note = [&](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
    if (!belief.ok()) ends.push_back(belief.status().code());
    return true;
  };
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 9}}, note).ok());
  ASSERT_TRUE(host.Subscribe(note).ok());
  bool ran = false;
  ASSERT_TRUE(host.Post([&](MissionWriter&) { ran = true; }).ok());
  host.Stop(absl::NotFoundError("deleted"));
  EXPECT_TRUE(ran);
  EXPECT_THAT(ends, testing::ElementsAre(absl::StatusCode::kNotFound, absl::StatusCode::kNotFound));
  EXPECT_TRUE(absl::IsNotFound(host.Post([](MissionWriter&) {})));
}

TEST(MissionHostTest, WhatCommandsHoldMayCallTheHostWhenItGoes) {
  MissionHost host(HostParts(), {});
  struct Releaser {
    explicit Releaser(MissionHost& h) : owner(h) { EXPECT_TRUE(owner.Reserve(1).ok()); }
    ~Releaser() { owner.Release(1); }
    MissionHost& owner;
  };
  ASSERT_TRUE(host.Post([held = std::make_shared<Releaser>(host)](MissionWriter&) {}).ok());
  Settle(host);
  Settle(host);
}

TEST(MissionHostTest, SummaryFollowsTheMission) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  PostGas(host, 1, 3);
  host.Stop(absl::NotFoundError("deleted"));
  EXPECT_EQ(host.summary().revision, 4);
}

}  // namespace mission_host_test
}  // namespace plumescout::server
