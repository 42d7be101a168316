// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/robot_notices.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "absl/synchronization/blocking_counter.h"
#include "absl/synchronization/notification.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/types/error_reason.h"
#include "server/base/worker_pool.h"

namespace plumescout::server {
namespace robot_notices_test {

class Watcher final : public RobotWatcher {
 public:
  void Wake() override { ++wakes; }
  void End(const absl::Status& status) override { end = status; }

  std::atomic<int> wakes = 0;
  absl::Status end;
};

RobotNotices::Submit On(WorkerPool& pool) {
  return [&pool](std::function<void()> look) { return pool.Submit(std::move(look)); };
}

class RobotNoticesTest : public ::testing::Test {
 protected:
  RobotNoticesTest() {
    auto belief = std::make_shared<Belief>(*Mission(MissionOptions{}).Snapshot());
    belief->revision = 1;
    belief_ = belief;
    for (const char* robot : {"r1", "r2"}) {
      belief->robots[robot].state.id = robot;
      leases_.Grant(robot, kLease);
    }
  }
  absl::Status Join(const std::shared_ptr<Watcher>& watcher, const RobotId& robot = "r1",
                    std::optional<std::int64_t> lease = kLease) {
    return notices_->Join(watcher, robot, lease, On(pool_), *belief_, leases_, state_);
  }
  // A watcher that has heard how its robot stands.
  std::shared_ptr<Watcher> Joined(const RobotId& robot = "r1") {
    auto watcher = std::make_shared<Watcher>();
    EXPECT_TRUE(Join(watcher, robot).ok());
    EXPECT_TRUE(notices_->Next(watcher.get()).has_value());
    return watcher;
  }
  // The mission goes on to a next revision, at which there is a look.
  void Look(const std::function<void(Belief&)>& change) {
    auto belief = std::make_shared<Belief>(*belief_);
    ++belief->revision;
    change(*belief);
    belief_ = belief;
    now_ = After(now_, absl::Seconds(1));
    notices_->Look(belief_, now_);
    absl::Notification done;  // the pool has one thread
    ASSERT_TRUE(pool_.Submit([&] { done.Notify(); }).ok());
    done.WaitForNotification();
  }
  // Robot r1 has a plan that it did not ask for.
  static void Assign(Belief& belief, PlanId plan) {
    RobotRecord& record = belief.robots["r1"];
    record.last_plan = record.assigned_plan = plan;
    Trajectory way;
    way.waypoints = {{{0.0, 0.0, 0.0}}, {{1.0, 0.0, 0.0}, 1.0}};
    way.duration_s = 1.0;
    record.live_trajectory = std::make_shared<const Trajectory>(way);
  }

  static constexpr std::int64_t kLease = 7;
  static constexpr absl::Duration kHold = absl::Hours(1);

  WorkerPool pool_{{"looks", 1, 100}};
  LeaseTable leases_{kHold, 1, [this] { return now_; }};
  MissionState state_ = MissionState::kRunning;
  std::shared_ptr<const Belief> belief_;
  SteadyTime now_ = SteadyNow();
  std::shared_ptr<RobotNotices> notices_ =
      std::make_shared<RobotNotices>(&MissionMetrics::Unread());
};

TEST_F(RobotNoticesTest, TheFirstNoticeSaysHowTheRobotStands) {
  const auto watcher = std::make_shared<Watcher>();
  ASSERT_TRUE(Join(watcher).ok());
  EXPECT_EQ(notices_->Next(watcher.get()), RobotNotice(RobotStanding{.leased = true}));
  EXPECT_EQ(notices_->Next(watcher.get()), std::nullopt);
  EXPECT_EQ(notices_->watcher_count(), 1);
  notices_->Leave(watcher.get());
  EXPECT_EQ(notices_->watcher_count(), 0);
}

TEST_F(RobotNoticesTest, WhoMayNotWatchDoesNotJoin) {
  const auto watcher = std::make_shared<Watcher>();
  EXPECT_EQ(ErrorReason(Join(watcher, "r9")), "ROBOT_NOT_FOUND");
  EXPECT_EQ(ErrorReason(Join(watcher, "r1", kLease - 1)), "LEASE_SUPERSEDED");
  EXPECT_EQ(notices_->watcher_count(), 0);
  EXPECT_TRUE(Join(watcher, "r1", std::nullopt).ok());
}

TEST_F(RobotNoticesTest, OneRobotHasSoManyWatchersWithItsLeaseAndAsManyWithout) {
  notices_ = std::make_shared<RobotNotices>(&MissionMetrics::Unread(), 1);
  const auto own = Joined();
  const auto overseer = std::make_shared<Watcher>();
  ASSERT_TRUE(Join(overseer, "r1", std::nullopt).ok());
  const auto late = std::make_shared<Watcher>();
  for (const std::optional<std::int64_t> lease :
       {std::optional(kLease), std::optional<std::int64_t>()}) {
    const absl::Status refused = Join(late, "r1", lease);
    EXPECT_TRUE(absl::IsResourceExhausted(refused)) << refused;
    EXPECT_EQ(ErrorReason(refused), "LIMIT_REACHED");
  }
  EXPECT_EQ(notices_->watcher_count(), 2);
  EXPECT_TRUE(Join(late, "r2").ok());
  notices_->Leave(own.get());
  EXPECT_TRUE(Join(std::make_shared<Watcher>(), "r1").ok());
}

TEST_F(RobotNoticesTest, ChangesOfTheMissionsStateAreToldAtOnce) {
  const auto watcher = Joined();
  notices_->Follow(leases_, MissionState::kPaused);
  EXPECT_EQ(watcher->wakes, 1);
  EXPECT_EQ(notices_->Next(watcher.get()),
            RobotNotice(RobotStanding{.paused = true, .leased = true}));
  notices_->Follow(leases_, MissionState::kPaused);
  EXPECT_EQ(watcher->wakes, 1);
  notices_->Follow(leases_, MissionState::kFinished);
  EXPECT_EQ(notices_->Next(watcher.get()),
            RobotNotice(RobotStanding{.finished = true, .leased = true}));
}

TEST_F(RobotNoticesTest, ASlowWatcherGetsTheNewestOfEachKind) {
  const auto watcher = Joined();
  Look([](Belief& belief) { Assign(belief, 1); });
  notices_->Follow(leases_, MissionState::kPaused);
  Look([](Belief& belief) { Assign(belief, 2); });
  notices_->Follow(leases_, MissionState::kRunning);
  Look([](Belief& belief) {
    Assign(belief, 3);
    belief.robots["r1"].state.ordered_home = true;
  });
  EXPECT_EQ(notices_->Next(watcher.get()),
            RobotNotice(RobotStanding{.ordered_home = true, .leased = true}));
  const auto invalidated = notices_->Next(watcher.get());
  ASSERT_TRUE(invalidated.has_value());
  EXPECT_EQ(std::get<PlanInvalidated>(*invalidated).plan, 2);
  EXPECT_EQ(notices_->Next(watcher.get()), RobotNotice(PlanAssigned{3}));
  EXPECT_EQ(notices_->Next(watcher.get()), std::nullopt);
}

TEST_F(RobotNoticesTest, WhoComesLaterIsToldWhatStillHolds) {
  const auto first = Joined("r2");  // looks are for watchers
  Look([](Belief& belief) { Assign(belief, 1); });
  EXPECT_EQ(notices_->Next(first.get()), std::nullopt);  // of another robot
  const auto second = Joined();
  EXPECT_EQ(notices_->Next(second.get()), RobotNotice(PlanAssigned{1}));
  Look([](Belief& belief) { belief.robots["r1"].last_plan = 2; });
  const auto third = Joined();
  EXPECT_EQ(notices_->Next(third.get()), std::nullopt);
}

TEST_F(RobotNoticesTest, WhoseLeaseIsTakenHearsNoMore) {
  const auto of_r1 = Joined();
  const auto of_r2 = Joined("r2");
  const auto overseer = std::make_shared<Watcher>();
  ASSERT_TRUE(Join(overseer, "r1", std::nullopt).ok());
  leases_.Grant("r1", kLease + 1);
  notices_->Follow(leases_, state_);
  EXPECT_EQ(ErrorReason(of_r1->end), "LEASE_SUPERSEDED");
  EXPECT_TRUE(of_r2->end.ok());
  EXPECT_TRUE(overseer->end.ok());
  EXPECT_EQ(notices_->watcher_count(), 2);
  leases_.Remove("r1");
  notices_->Follow(leases_, state_);
  EXPECT_EQ(ErrorReason(overseer->end), "ROBOT_NOT_FOUND");
}

TEST_F(RobotNoticesTest, ALeaseThatRunsOutIsTold) {
  const auto watcher = Joined();
  EXPECT_EQ(notices_->next_follow(leases_, now_), After(now_, kHold));
  now_ = After(now_, kHold);
  EXPECT_EQ(notices_->next_follow(leases_, now_), now_);
  notices_->Follow(leases_, state_);
  EXPECT_EQ(notices_->Next(watcher.get()), RobotNotice(RobotStanding{.leased = false}));
  EXPECT_EQ(notices_->next_follow(leases_, now_), SteadyTime::max()) << "it was told";
}

TEST_F(RobotNoticesTest, ALeaseRunsOutOnceItsStreamIsClosed) {
  const auto watcher = Joined();
  const auto stream = leases_.OpenStream("r1", kLease, nullptr);
  ASSERT_TRUE(stream.ok());
  EXPECT_EQ(notices_->next_follow(leases_, now_), SteadyTime::max());
  now_ = After(now_, 2 * kHold);
  leases_.CloseStream("r1", *stream);
  EXPECT_EQ(notices_->next_follow(leases_, now_), After(now_, kHold));
}

TEST_F(RobotNoticesTest, ALookForWhichThereWasNoRoomIsMadeUpFor) {
  WorkerPool full({"full", 1, 1});
  absl::Notification busy;
  absl::Notification go_on;
  ASSERT_TRUE(full.Submit([&] {
                    busy.Notify();
                    go_on.WaitForNotification();
                  })
                  .ok());
  busy.WaitForNotification();
  ASSERT_TRUE(full.Submit([] {}).ok());
  const auto watcher = std::make_shared<Watcher>();
  ASSERT_TRUE(notices_->Join(watcher, "r1", kLease, On(full), *belief_, leases_, state_).ok());
  ASSERT_TRUE(notices_->Next(watcher.get()).has_value());
  auto belief = std::make_shared<Belief>(*belief_);
  ++belief->revision;
  Assign(*belief, 1);
  notices_->Look(belief, now_);
  EXPECT_EQ(notices_->next_look(belief->revision), After(now_, RobotNotices::kLookPeriod));
  go_on.Notify();
  absl::Notification drained;
  while (!full.Submit([&] { drained.Notify(); }).ok()) std::this_thread::yield();
  drained.WaitForNotification();
  notices_->Look(belief, After(now_, RobotNotices::kLookPeriod));
  EXPECT_EQ(notices_->next_look(belief->revision), SteadyTime::max());
  absl::Notification looked;
  while (!full.Submit([&] { looked.Notify(); }).ok()) std::this_thread::yield();
  looked.WaitForNotification();
  EXPECT_EQ(notices_->Next(watcher.get()), RobotNotice(PlanAssigned{1}));
}

TEST_F(RobotNoticesTest, ALookDuringALookIsMadeUpFor) {
  absl::Notification go_on;
  ASSERT_TRUE(pool_.Submit([&] { go_on.WaitForNotification(); }).ok());
  const auto watcher = Joined();
  auto later = std::make_shared<Belief>(*belief_);
  later->revision = belief_->revision + 1;
  notices_->Look(belief_, now_);  // waits for the pool
  notices_->Look(later, now_);
  EXPECT_EQ(notices_->next_look(later->revision), After(now_, RobotNotices::kLookPeriod));
  go_on.Notify();
  absl::Notification done;
  ASSERT_TRUE(pool_.Submit([&] { done.Notify(); }).ok());
  done.WaitForNotification();
}

TEST_F(RobotNoticesTest, LooksAreForNewsAndForWatchersAndNotTooOften) {
  EXPECT_EQ(notices_->next_look(2), SteadyTime::max());
  const auto watcher = Joined();
  EXPECT_LE(notices_->next_look(2), now_);
  Look([](Belief&) {});
  EXPECT_EQ(notices_->next_look(belief_->revision), SteadyTime::max());
  EXPECT_EQ(notices_->next_look(belief_->revision + 1), After(now_, RobotNotices::kLookPeriod));
}

}  // namespace robot_notices_test
}  // namespace plumescout::server
