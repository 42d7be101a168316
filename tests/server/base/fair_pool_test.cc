// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/fair_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "absl/time/time.h"
#include "core/types/error_reason.h"

namespace plumescout::server {
namespace fair_pool_test {

using ::testing::ElementsAre;

// A pool of one thread, which "z" holds until Release: what is queued meanwhile shows its order.
class FairPoolTest : public testing::Test {
 protected:
  void Start(FairPoolOptions options) {
    options.threads = 1;
    pool_.emplace(options);
    ASSERT_TRUE(pool_
                    ->Submit({"z", "z"}, {[this] {
                               occupied_.Notify();
                               release_.WaitForNotification();
                             }})
                    .ok());
    occupied_.WaitForNotification();
  }
  absl::Status Queue(const std::string& group, const std::string& member,
                     StopFn abandoned = NeverStop(), const std::string& tenant = "") {
    return pool_->Submit({group, member, tenant},
                         {[this, group, member] { ran_.push_back(group + member); }, abandoned});
  }
  const std::vector<std::string>& RunAll() {
    release_.Notify();
    pool_.reset();
    return ran_;
  }

  absl::Notification occupied_;
  absl::Notification release_;
  std::vector<std::string> ran_;
  std::optional<FairPool> pool_;  // goes first: its thread uses the above
};

TEST_F(FairPoolTest, GroupsTakeTurnsWhateverTheyQueue) {
  Start({});
  for (const char* group : {"a", "a", "a", "b", "c"}) ASSERT_TRUE(Queue(group, "1").ok());
  EXPECT_THAT(RunAll(), ElementsAre("a1", "b1", "c1", "a1", "a1"));
}

TEST_F(FairPoolTest, MembersOfAGroupTakeTurns) {
  Start({});
  for (const char* member : {"1", "1", "1", "2"}) ASSERT_TRUE(Queue("a", member).ok());
  EXPECT_THAT(RunAll(), ElementsAre("a1", "a2", "a1", "a1"));
}

TEST_F(FairPoolTest, EachQueueHasItsBound) {
  Start({.name = "test", .max_queued = 5, .max_queued_per_group = 3, .max_queued_per_member = 2});
  EXPECT_TRUE(Queue("a", "1").ok());
  EXPECT_TRUE(Queue("a", "1").ok());
  const absl::Status refused = Queue("a", "1");
  EXPECT_EQ(ErrorReason(refused), reason::kOverloaded) << "of a member";
  EXPECT_TRUE(RetryAfter_ns(refused).has_value());
  EXPECT_TRUE(Queue("a", "2").ok());
  EXPECT_EQ(ErrorReason(Queue("a", "3")), reason::kOverloaded) << "of a group";
  EXPECT_TRUE(Queue("b", "1").ok());
  EXPECT_TRUE(Queue("c", "1").ok());
  EXPECT_EQ(ErrorReason(Queue("d", "1")), reason::kOverloaded) << "in all";
  EXPECT_EQ(RunAll().size(), 5u);
}

TEST_F(FairPoolTest, TenantsTakeTurnsHoweverManyGroupsTheyHave) {
  Start({});
  for (const char* group : {"a", "b", "c"}) ASSERT_TRUE(Queue(group, "1").ok());
  ASSERT_TRUE(Queue("d", "1", NeverStop(), "other").ok());
  ASSERT_TRUE(Queue("d", "2", NeverStop(), "other").ok());
  EXPECT_THAT(RunAll(), ElementsAre("d1", "a1", "d2", "b1", "c1"));
}

TEST_F(FairPoolTest, WhoIsNotAloneLeavesAQuarterOfTheQueue) {
  Start({.name = "test", .max_queued = 8, .groups_leave_room = true});
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(Queue("a", std::to_string(i)).ok());
  EXPECT_EQ(ErrorReason(Queue("a", "6")), reason::kOverloaded);
  EXPECT_TRUE(Queue("b", "1").ok());
  EXPECT_EQ(ErrorReason(Queue("b", "2")), reason::kOverloaded) << "nobody has two of the last";
  EXPECT_TRUE(Queue("c", "1").ok());
  EXPECT_EQ(ErrorReason(Queue("d", "1")), reason::kOverloaded) << "in all";
  EXPECT_EQ(RunAll().size(), 8u);
}

TEST_F(FairPoolTest, TenantsLeaveTheirQuarterTooAndOneAloneNone) {
  Start({.name = "test", .max_queued = 4});
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(Queue("a", std::to_string(i)).ok()) << "alone";
  EXPECT_EQ(ErrorReason(Queue("b", "1", NeverStop(), "other")), reason::kOverloaded);
  release_.Notify();
  while (pool_->queued() > 0) std::this_thread::yield();
  absl::Notification busy;
  absl::Notification go_on;
  ASSERT_TRUE(pool_
                  ->Submit({"z", "z"}, {[&] {
                             busy.Notify();
                             go_on.WaitForNotification();
                           }})
                  .ok());
  busy.WaitForNotification();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Queue("a", std::to_string(i)).ok());
  EXPECT_EQ(ErrorReason(Queue("a", "3")), reason::kOverloaded) << "another asked";
  EXPECT_TRUE(Queue("b", "1", NeverStop(), "other").ok());
  go_on.Notify();
  pool_.reset();
  EXPECT_EQ(ran_.size(), 8u);
}

TEST_F(FairPoolTest, WhatNobodyWantsGivesWay) {
  Start({.name = "test", .max_queued = 3, .max_queued_per_group = 2, .max_queued_per_member = 1});
  bool gone = false;
  const auto held = std::make_shared<int>();
  const StopFn abandoned = [&gone, held] { return gone; };
  ASSERT_TRUE(Queue("a", "1", abandoned).ok());
  EXPECT_FALSE(Queue("a", "1").ok());
  gone = true;
  EXPECT_TRUE(Queue("a", "1").ok());
  EXPECT_EQ(pool_->queued(), 1);
  EXPECT_EQ(held.use_count(), 2) << "the queue let go of it";
  EXPECT_THAT(RunAll(), ElementsAre("a1"));
}

TEST_F(FairPoolTest, WhatNobodyWantsIsNotRun) {
  Start({});
  ASSERT_TRUE(Queue("a", "1", [] { return true; }).ok());
  ASSERT_TRUE(Queue("a", "2").ok());
  EXPECT_THAT(RunAll(), ElementsAre("a2"));
}

TEST(FairPoolThreadsTest, OneGroupLeavesAThreadToTheOthers) {
  absl::Notification held;
  absl::Notification release;
  absl::Notification ran;
  std::atomic<int> running = 0;
  std::atomic<int> most = 0;
  const auto hold = [&] {
    most = std::max<int>(most, ++running);
    if (!held.HasBeenNotified()) held.Notify();
    release.WaitForNotification();
    --running;
  };
  FairPool pool({.name = "test", .threads = 2, .max_running_per_group = 1});
  for (const char* member : {"1", "2", "3"}) {
    ASSERT_TRUE(pool.Submit({"greedy", member}, {hold}).ok());
  }
  ASSERT_TRUE(pool.Submit({"other", "1"}, {[&] { ran.Notify(); }}).ok());
  held.WaitForNotification();
  ran.WaitForNotification();  // would hang if the first group held both threads
  EXPECT_EQ(most, 1);
  release.Notify();
}

TEST(FairPoolThreadsTest, OneMemberLeavesAThreadToTheOthersOfItsGroup) {
  absl::Notification release;
  absl::Notification other_ran;
  std::atomic<int> greedy = 0;
  FairPool pool({.name = "test", .threads = 2, .max_running_per_group = 2});
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(pool.Submit({"a", "1"}, {[&] {
                              ++greedy;
                              release.WaitForNotification();
                            }})
                    .ok());
  }
  ASSERT_TRUE(pool.Submit({"a", "2"}, {[&] { other_ran.Notify(); }}).ok());
  other_ran.WaitForNotification();  // would hang if the first member had both threads
  EXPECT_LE(greedy, 1);
  release.Notify();
}

// Tasks of one tenant that hold their threads until the end, and one of another's.
class FairPoolCompanyTest : public testing::Test {
 protected:
  ~FairPoolCompanyTest() override {
    release_.Notify();
    pool_.reset();
  }
  // A task of its own group.
  void Hold(const std::string& tenant) {
    const std::string group = absl::StrCat(tenant, ++groups_made_);
    ASSERT_TRUE(pool_
                    ->Submit({group, "1", tenant}, {[this] {
                               ++holding_;
                               release_.WaitForNotification();
                             }})
                    .ok());
  }
  void AwaitHolding(int threads) {
    while (holding_ < threads) std::this_thread::yield();
  }
  void Pass(const std::string& tenant) {
    absl::Notification ran;
    ASSERT_TRUE(pool_->Submit({tenant, "1", tenant}, {[&] { ran.Notify(); }}).ok());
    ran.WaitForNotification();  // would hang if all threads were held
  }

  absl::Notification release_;
  std::atomic<int> holding_ = 0;
  int groups_made_ = 0;
  std::atomic<SteadyTime::rep> later_ = 0;
  std::atomic<int> clock_reads_ = 0;
  std::optional<FairPool> pool_{std::in_place, FairPoolOptions{.name = "test", .threads = 3},
                                [this] {
                                  ++clock_reads_;
                                  return SteadyNow() + SteadyTime::duration(later_);
                                }};
};

TEST_F(FairPoolCompanyTest, ATenantAloneHasAllThreads) {
  for (int i = 0; i < 3; ++i) Hold("a");
  AwaitHolding(3);
}

TEST_F(FairPoolCompanyTest, ATenantLeavesAThreadToOneThatAskedLately) {
  Pass("other");
  for (int i = 0; i < 4; ++i) Hold("a");
  AwaitHolding(2);
  for (int i = 0; i < 20; ++i) Pass("other");
  EXPECT_EQ(holding_, 2);
}

TEST_F(FairPoolCompanyTest, CompanyThatHasNotAskedForLongIsNone) {
  Pass("other");
  later_ = absl::ToChronoNanoseconds(FairPool::kCompany + absl::Seconds(1)).count();
  for (int i = 0; i < 3; ++i) Hold("a");
  AwaitHolding(3);
}

TEST_F(FairPoolCompanyTest, GroupsWhoseTasksTakeLongLeaveTwoThreadsToThoseWhoseDoNot) {
  for (const char* slow : {"slow1", "slow2"}) {
    absl::Notification ran;
    ASSERT_TRUE(pool_
                    ->Submit({slow, "1"}, {[&] {
                               later_ += absl::ToChronoNanoseconds(2 * FairPool::kLong).count();
                               ran.Notify();
                             }})
                    .ok());
    ran.WaitForNotification();
    while (pool_->load().busy_threads > 0) std::this_thread::yield();
    Pass(slow);  // one that does not changes nothing
  }
  Pass("");
  for (const char* slow : {"slow1", "slow2", "slow1", "slow2"}) {
    ASSERT_TRUE(pool_
                    ->Submit({slow, absl::StrCat(++groups_made_)}, {[this] {
                               ++holding_;
                               release_.WaitForNotification();
                             }})
                    .ok());
  }
  AwaitHolding(1);
  for (int i = 0; i < 20; ++i) Pass("");
  EXPECT_EQ(holding_, 1);
}

// Under the lock, on the thread of whoever asks.
TEST_F(FairPoolCompanyTest, ALookAtThoseWhoWaitIsOneHoweverManyTheyAre) {
  constexpr int kGroups = 15;
  const auto slow = [](int i) { return absl::StrCat("slow", i); };
  for (int i = 0; i < kGroups; ++i) {
    absl::Notification ran;
    ASSERT_TRUE(pool_
                    ->Submit({slow(i), "1"}, {[&] {
                               later_ += absl::ToChronoNanoseconds(2 * FairPool::kLong).count();
                               ran.Notify();
                             }})
                    .ok());
    ran.WaitForNotification();
    while (pool_->load().busy_threads > 0) std::this_thread::yield();
  }
  Pass("");
  for (int i = 0; i < kGroups; ++i) {
    ASSERT_TRUE(pool_
                    ->Submit({slow(i), "1"}, {[this] {
                               ++holding_;
                               release_.WaitForNotification();
                             }})
                    .ok());
  }
  AwaitHolding(1);
  while (pool_->load().busy_threads > 1) std::this_thread::yield();
  const int before = clock_reads_;
  ASSERT_TRUE(pool_->Submit({slow(1), "2"}, {[] {}}).ok());
  EXPECT_LT(clock_reads_ - before, kGroups);
  EXPECT_EQ(holding_, 1);
}

TEST(FairPoolThreadsTest, YieldsTheCpuIfItIsToldTo) {
  const auto niceness_in = [](bool yields) {
    int niceness = 0;
    {
      FairPool pool({.name = "test", .threads = 1, .yields = yields});
      EXPECT_TRUE(pool.Submit({}, {[&] { niceness = getpriority(PRIO_PROCESS, 0); }}).ok());
    }
    return niceness;
  };
  constexpr int kNicest = 19;
  const int usual = niceness_in(false);
  EXPECT_TRUE(niceness_in(true) > usual || usual == kNicest);
}

TEST(FairPoolThreadsTest, GroupsThatShallDoLeaveAThreadToOneAnother) {
  absl::Notification release;
  std::atomic<int> greedy = 0;
  FairPool pool({.name = "test",
                 .threads = 2,
                 .max_running_per_group = 2,
                 .max_running_per_member = 2,
                 .groups_leave_room = true});
  const auto hold = [&] {
    ++greedy;
    release.WaitForNotification();
  };
  const auto pass = [&] {
    absl::Notification ran;
    ASSERT_TRUE(pool.Submit({"other", "1"}, {[&] { ran.Notify(); }}).ok());
    ran.WaitForNotification();  // would hang if the first group had both threads
  };
  pass();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(pool.Submit({"greedy", "1"}, {hold}).ok());
  for (int i = 0; i < 20; ++i) pass();
  EXPECT_LE(greedy, 1);
  release.Notify();
}

TEST(FairPoolThreadsTest, RunsWhatItIsGivenBeforeItGoes) {
  std::atomic<int> runs = 0;
  {
    FairPool pool({.name = "test",
                   .threads = 3,
                   .max_queued = 100,
                   .max_queued_per_group = 100,
                   .max_queued_per_member = 100,
                   .max_running_per_group = 2});
    for (int i = 0; i < 100; ++i) {
      ASSERT_TRUE(pool.Submit({i % 2 == 0 ? "a" : "b", "1"}, {[&] { ++runs; }}).ok());
    }
  }
  EXPECT_EQ(runs, 100);
}

}  // namespace fair_pool_test
}  // namespace plumescout::server
