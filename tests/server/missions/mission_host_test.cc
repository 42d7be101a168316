// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "absl/synchronization/mutex.h"
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
    Settle(host);
    host.Stop(absl::NotFoundError("deleted"));
  }
  release.Notify();
}

// Holds up the writer of a host until Release.
class BusyWriter {
 public:
  explicit BusyWriter(MissionHost& host) {
    EXPECT_TRUE(host.Post([state = state_](MissionWriter&) {
                      state->busy.Notify();
                      state->released.WaitForNotification();
                    })
                    .ok());
    state_->busy.WaitForNotification();
  }
  void Release() { state_->released.Notify(); }

 private:
  struct State {
    absl::Notification busy;
    absl::Notification released;
  };
  const std::shared_ptr<State> state_ = std::make_shared<State>();
};

TEST(MissionHostTest, RoomIsTakenWhileObservationsWait) {
  HostOptions options;
  options.max_queued_observations = 10;
  MissionHost host(HostParts(), options);
  BusyWriter writer(host);
  auto room = host.room().TryTake({10, 1});
  ASSERT_NE(room, nullptr);
  ASSERT_TRUE(host.Post({[](MissionWriter&) {}, nullptr, std::move(room)}).ok());
  EXPECT_EQ(host.room().TryTake({1, 1}), nullptr);
  writer.Release();
  Settle(host);
  EXPECT_NE(host.room().TryTake({10, 1}), nullptr);
}

TEST(MissionHostTest, CommandsThatHaveRoomAreAlwaysTaken) {
  HostOptions options;
  options.max_queued_commands = 1;
  MissionHost host(HostParts(), options);
  BusyWriter writer(host);
  int ran = 0;
  absl::Notification done;
  const auto count = [&](MissionWriter&) {
    if (++ran == 3) done.Notify();
  };
  EXPECT_TRUE(host.Post([](MissionWriter&) {}).ok());
  EXPECT_TRUE(absl::IsResourceExhausted(host.Post([](MissionWriter&) {})));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(host.Post({count, nullptr, host.room().TryTake({1, 1})}).ok());
  }
  writer.Release();
  done.WaitForNotification();
}

TEST(MissionHostTest, TooManyCommandsAreRefused) {
  HostOptions options;
  options.max_queued_commands = 1;
  MissionHost host(HostParts(), options);
  BusyWriter writer(host);
  EXPECT_TRUE(host.Post([](MissionWriter&) {}).ok());
  EXPECT_TRUE(absl::IsResourceExhausted(host.Post([](MissionWriter&) {})));
  writer.Release();
}

TEST(MissionHostTest, NobodyWaitsLongerThanTheMissionAllows) {
  HostOptions options;
  options.max_wait = absl::Milliseconds(5);
  MissionHost host(HostParts(), options);
  AddRobot(host);
  absl::Notification dropped;
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 2}},
                               [&](const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
                                 EXPECT_TRUE(absl::IsDeadlineExceeded(belief.status()));
                                 dropped.Notify();
                               })
                  .ok());
  dropped.WaitForNotification();
}

TEST(MissionHostTest, StopFailsWhoWaitsAndWhoWatches) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  absl::Mutex mutex;  // who stops it fails the one, its writer the other
  std::vector<absl::StatusCode> ends;
  const auto note = [&](const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
    absl::MutexLock lock(&mutex);
    if (!belief.ok()) ends.push_back(belief.status().code());
    return true;
  };
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 9}}, note).ok());
  ASSERT_TRUE(host.Subscribe(note).ok());
  Settle(host);
  host.Stop(absl::NotFoundError("deleted"));
  EXPECT_THAT(ends, testing::ElementsAre(absl::StatusCode::kNotFound, absl::StatusCode::kNotFound));
  EXPECT_TRUE(absl::IsNotFound(host.Post([](MissionWriter&) {})));
}

TEST(MissionHostTest, WhatIsQueuedIsDroppedThoughTheWriterIsBusy) {
  MissionHost host(HostParts(), {});
  BusyWriter writer(host);
  std::vector<absl::StatusCode> ends;
  const auto note = [&](const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
    ends.push_back(belief.status().code());
    return false;
  };
  bool ran = false;
  ASSERT_TRUE(host.Post([&](MissionWriter&) { ran = true; },
                        [&](const absl::Status& status) { ends.push_back(status.code()); })
                  .ok());
  ASSERT_TRUE(host.Post([&](MissionWriter&) { ran = true; }).ok());
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1"}}, note).ok());
  ASSERT_TRUE(host.Subscribe(note).ok());
  host.BeginStop(absl::NotFoundError("deleted"));
  host.DropAll();
  EXPECT_THAT(ends, testing::ElementsAre(absl::StatusCode::kNotFound, absl::StatusCode::kNotFound,
                                         absl::StatusCode::kNotFound));
  writer.Release();
  host.Stop(absl::UnavailableError("too late"));
  EXPECT_FALSE(ran);
}

TEST(MissionHostTest, StopEndsRefreshes) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  absl::Notification refreshing;
  ASSERT_TRUE(host.Post([&](MissionWriter& writer) {
                    const auto log = RoomRunBatch();
                    writer.conduct().Ingest("r1", kLease, log);
                    EXPECT_TRUE(writer.conduct().Refresh().ok());
                    refreshing.Notify();
                    auto next = static_cast<std::int64_t>(log.size());
                    do {
                      ++next;
                      writer.conduct().Ingest("r1", kLease, GasBatch(next, next));
                    } while (!absl::IsCancelled(writer.conduct().Refresh()));
                  })
                  .ok());
  refreshing.WaitForNotification();
  host.Stop(absl::NotFoundError("deleted"));  // would hang if refreshes went on
}

TEST(MissionHostTest, WhoWaitsIsFailedThoughTheWriterIsBusy) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  absl::Status end;
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 9}},
                               [&](const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
                                 end = belief.status();
                               })
                  .ok());
  Settle(host);
  BusyWriter writer(host);
  absl::Status heard;
  host.end_listeners().Add([&](const absl::Status& status) { heard = status; });
  host.EndWaits(absl::UnavailableError("draining"));
  EXPECT_TRUE(absl::IsUnavailable(end));
  EXPECT_TRUE(absl::IsUnavailable(heard));
  EXPECT_TRUE(host.Post([](MissionWriter&) {}).ok()) << "commands go on";
  writer.Release();
}

TEST(MissionHostTest, WhoGivesUpIsLetGoThoughTheWriterIsBusy) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  std::atomic<bool> gone = false;
  absl::Status end;
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 9},
                                .abandoned = [&] { return gone.load(); }},
                               [&](const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
                                 end = belief.status();
                               })
                  .ok());
  Settle(host);
  BusyWriter writer(host);
  gone = true;
  host.Wake();
  EXPECT_TRUE(absl::IsCancelled(end));
  writer.Release();
}

TEST(MissionHostTest, WhatCommandsHoldMayCallTheHostWhenItGoes) {
  MissionHost host(HostParts(), {});
  struct Caller {
    explicit Caller(MissionHost& h) : owner(h) {}
    ~Caller() {
      EXPECT_TRUE(owner.Post([](MissionWriter&) {}).ok());
    }
    MissionHost& owner;
  };
  ASSERT_TRUE(host.Post([held = std::make_shared<Caller>(host)](MissionWriter&) {}).ok());
  Settle(host);
  Settle(host);
}

TEST(MissionHostTest, SummaryFollowsTheMission) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  PostGas(host, 1, 3);
  Settle(host);
  host.Stop(absl::NotFoundError("deleted"));
  EXPECT_EQ(host.summary().revision, 4);
}

}  // namespace mission_host_test
}  // namespace plumescout::server
