// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/figure_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/server/history/past_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace figure_replay_test {

class FigureReplayTest : public testing::Test {
 protected:
  void SetUp() override {
    RegistryHooks hooks;
    hooks.store = &store_;
    registry_ = std::make_unique<MissionRegistry>(RegistryOptions{}, hooks);
    ASSERT_TRUE(registry_->Recover("hall").ok());
    host_ = *registry_->Find("hall");
    past_ = std::make_unique<PastMissions>(&store_, registry_.get());
    replay_ = std::make_shared<FigureReplay>(host_, past_.get(), [this] { return now_; });
    pool_ = std::make_unique<FairPool>(FairPoolOptions{.name = "past", .threads = 1});
  }
  absl::StatusOr<v1::GetMissionFiguresResponse> Ask() { return replay_->Ask({pool_.get()}); }
  // Once all that was queued so far, with what that has queued, has run.
  absl::StatusOr<v1::GetMissionFiguresResponse> AskUntilDone() {
    auto answer = Ask();
    while (answer.ok() && answer->more_follow()) {
      absl::Notification ran;
      EXPECT_TRUE(pool_->Submit({}, {[&] { ran.Notify(); }}).ok());
      ran.WaitForNotification();
      answer = Ask();
    }
    return answer;
  }
  // So many events happen that the journal may be replayed again.
  void MoveOn() {
    absl::Notification durable;
    const auto happen = [](MissionWriter& writer) {
      for (int i = 0; i < 100; ++i) {
        EXPECT_TRUE(writer.conduct().OrderHome({"r1"}, i % 2 == 0).ok());
      }
    };
    ASSERT_TRUE(host_->Post(happen).ok());
    ASSERT_TRUE(host_
                    ->Post([&](MissionWriter&) {
                      host_->WhenDurable([&](const absl::Status& status) {
                        EXPECT_TRUE(status.ok()) << status;
                        durable.Notify();
                      });
                    })
                    .ok());
    durable.WaitForNotification();
  }

  MemoryStore store_{/*is_durable=*/true};
  const PastRun run_ = StoreRun(store_);
  SteadyTime now_ = SteadyNow();
  std::unique_ptr<MissionRegistry> registry_;
  std::shared_ptr<MissionHost> host_;
  std::unique_ptr<PastMissions> past_;
  std::shared_ptr<FigureReplay> replay_;
  std::unique_ptr<FairPool> pool_;  // goes first: what it runs uses the above
};

TEST_F(FigureReplayTest, FiguresLeadFromTheBeginningToNow) {
  const auto answer = AskUntilDone();
  ASSERT_TRUE(answer.ok()) << answer.status();
  ASSERT_GT(answer->figures_size(), 50);
  for (int i = 1; i < answer->figures_size(); ++i) {
    EXPECT_GT(answer->figures(i).revision(), answer->figures(i - 1).revision());
    EXPECT_GE(answer->figures(i).elapsed_s(), answer->figures(i - 1).elapsed_s());
  }
  const v1::MissionFigures& last = answer->figures(answer->figures_size() - 1);
  EXPECT_EQ(last.revision(), run_.revision());
  EXPECT_GT(last.elapsed_s(), 1.0);
  EXPECT_GT(last.known_area_m2(), answer->figures(0).known_area_m2());
  EXPECT_EQ(last.robots(0).robot(), "missions/hall/robots/r1");
}

TEST_F(FigureReplayTest, HoweverManyAskTheJournalIsReplayedOnce) {
  const auto answer = AskUntilDone();
  ASSERT_TRUE(answer.ok()) << answer.status();
  const int reads = store_.read_count();
  for (int page = 0; page < 16; ++page) {
    const auto again = Ask();
    ASSERT_TRUE(again.ok()) << again.status();
    EXPECT_FALSE(again->more_follow());
    EXPECT_EQ(again->SerializeAsString(), answer->SerializeAsString());
  }
  EXPECT_EQ(store_.read_count(), reads);
}

TEST_F(FigureReplayTest, WhoeverComesMeanwhileWaitsForTheSameReplay) {
  absl::Notification go_on;
  ASSERT_TRUE(pool_->Submit({}, {[&] { go_on.WaitForNotification(); }}).ok());
  const int reads = store_.read_count();
  for (int page = 0; page < 16; ++page) {
    const auto answer = Ask();
    ASSERT_TRUE(answer.ok()) << answer.status();
    EXPECT_TRUE(answer->more_follow());
  }
  go_on.Notify();
  ASSERT_TRUE(AskUntilDone().ok());
  EXPECT_EQ(store_.read_count(), reads + 1);
}

TEST_F(FigureReplayTest, WhatHappensMeanwhileKeepsNobodyWaiting) {
  absl::Notification go_on;
  ASSERT_TRUE(pool_->Submit({}, {[&] { go_on.WaitForNotification(); }}).ok());
  ASSERT_TRUE(Ask().ok());
  now_ += std::chrono::seconds(9);  // so long it takes
  go_on.Notify();
  ASSERT_TRUE(AskUntilDone().ok());
  MoveOn();
  now_ += std::chrono::seconds(8);
  EXPECT_FALSE(Ask()->more_follow());
  now_ += std::chrono::seconds(1);
  EXPECT_TRUE(Ask()->more_follow());
  const auto answer = AskUntilDone();
  ASSERT_TRUE(answer.ok()) << answer.status();
  EXPECT_EQ(answer->figures(answer->figures_size() - 1).revision(), run_.revision() + 100);
  MoveOn();
  EXPECT_FALSE(Ask()->more_follow());  // it took no time, and rests all the same
  now_ += std::chrono::seconds(5);
  EXPECT_TRUE(Ask()->more_follow());
}

TEST_F(FigureReplayTest, NobodyWhoAsksStopsIt) {
  absl::Notification go_on;
  ASSERT_TRUE(pool_->Submit({}, {[&] { go_on.WaitForNotification(); }}).ok());
  ASSERT_TRUE(Ask().ok());
  now_ += absl::ToChronoNanoseconds(FigureReplay::kPatience);
  const int reads = store_.read_count();
  go_on.Notify();
  absl::Notification ran;
  ASSERT_TRUE(pool_->Submit({}, {[&] { ran.Notify(); }}).ok());
  ran.WaitForNotification();
  EXPECT_EQ(store_.read_count(), reads);
  const auto answer = AskUntilDone();
  ASSERT_TRUE(answer.ok()) << answer.status();
  EXPECT_GT(answer->figures_size(), 50);
}

TEST_F(FigureReplayTest, WhatIsInTheWayIsToldOnceAndTriedAgain) {
  auto other = past_->Make(*host_, 1, "", PastUse::kFigures, NeverStop());
  ASSERT_TRUE(other.ok());
  EXPECT_TRUE(absl::IsResourceExhausted(AskUntilDone().status()));
  *other = {};
  EXPECT_TRUE(AskUntilDone().ok());
}

}  // namespace figure_replay_test
}  // namespace plumescout::server
