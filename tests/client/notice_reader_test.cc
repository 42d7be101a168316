// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/notice_reader.h"

#include <gtest/gtest.h>

#include <vector>

#include "absl/time/clock.h"
#include "tests/client/fake_planner_client.h"

namespace plumescout::client {
namespace notice_reader_test {

class NoticeReaderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server_.set_watched(true);
    server_.Preload(0);
    session_ = *server_.RegisterRobot("m", "r", 0.2, false);
  }
  void Poll(absl::Duration later = absl::ZeroDuration()) {
    now_ += later;
    reader_.Poll(session_, now_);
  }

  struct Doubts final : RobotObserver {
    void OnPlaceDoubted(bool doubted) override { told.push_back(doubted); }
    std::vector<bool> told;
  };

  FakePlannerClient server_;
  RobotSession session_;
  Doubts doubts_;
  NoticeReader reader_{server_, {.initial = absl::Seconds(1), .jitter = 0.0}, true, &doubts_};
  absl::Time now_ = absl::UnixEpoch();
};

TEST_F(NoticeReaderTest, KeepsTheNewestOfEachKind) {
  Poll();
  server_.Notify(RobotStanding{.paused = true});
  server_.Notify(PlanInvalidated{.plan = 3});
  server_.Notify(RobotStanding{.ordered_home = true});
  server_.Notify(PlanInvalidated{.plan = 4, .reason = InvalidationReason::kWayBlocked});
  server_.Notify(PlanAssigned{5});
  Poll();
  EXPECT_EQ(reader_.standing(), RobotStanding{.ordered_home = true});
  EXPECT_EQ(reader_.FindInvalidation(3), nullptr);
  ASSERT_NE(reader_.FindInvalidation(4), nullptr);
  EXPECT_EQ(reader_.FindInvalidation(4)->reason, InvalidationReason::kWayBlocked);
  EXPECT_EQ(server_.watches_opened(), 1);
}

TEST_F(NoticeReaderTest, DoubtsInTheRobotsPlaceAreToldOnce) {
  Poll();
  server_.Notify(RobotStanding{});
  server_.Notify(RobotStanding{.frame_suspect = true});
  server_.Notify(RobotStanding{.paused = true, .frame_suspect = true});
  Poll();
  EXPECT_EQ(doubts_.told, std::vector<bool>{true});
  server_.BreakLink();
  Poll();
  server_.MendLink();
  Poll(absl::Seconds(2));
  server_.Notify(RobotStanding{.frame_suspect = true});  // the first notice of the next watch
  Poll();
  EXPECT_EQ(doubts_.told, std::vector<bool>{true});
  server_.Notify(RobotStanding{});
  Poll();
  EXPECT_EQ(doubts_.told, (std::vector<bool>{true, false}));
}

TEST_F(NoticeReaderTest, ABrokenWatchIsOpenedAgainAfterAWhile) {
  Poll();
  server_.Notify(RobotStanding{.paused = true});
  Poll();
  server_.BreakLink();
  Poll();
  EXPECT_FALSE(reader_.standing().paused);  // as without
  Poll(absl::Seconds(0.5));
  server_.MendLink();
  Poll(absl::Seconds(0.4));
  EXPECT_EQ(server_.watches_opened(), 1);
  Poll(absl::Seconds(0.2));
  EXPECT_EQ(server_.watches_opened(), 2);
}

TEST_F(NoticeReaderTest, AServiceThatKnowsNoWatchesIsAskedOnce) {
  server_.set_watched(false);
  Poll();
  Poll(absl::Hours(1));
  server_.set_watched(true);
  Poll(absl::Hours(1));
  EXPECT_EQ(server_.watches_opened(), 0);
}

TEST_F(NoticeReaderTest, ANewLeaseIsWatchedAnew) {
  Poll();
  session_ = *server_.RegisterRobot("m", "r", 0.2, true);
  Poll();
  EXPECT_EQ(server_.watches_opened(), 2);
}

TEST_F(NoticeReaderTest, PlansOfAFormerLifeOfTheMissionStopNoneOfThePresentOne) {
  Poll();
  server_.Notify(PlanAssigned{5});
  server_.Notify(PlanInvalidated{.plan = 3});
  Poll();
  EXPECT_TRUE(reader_.TellsToStop(4, false));
  EXPECT_NE(reader_.FindInvalidation(3), nullptr);
  server_.BreakLink();
  Poll();
  server_.MendLink();
  Poll(absl::Seconds(2));
  ASSERT_EQ(server_.watches_opened(), 2);
  EXPECT_FALSE(reader_.TellsToStop(4, false));
  EXPECT_EQ(reader_.FindInvalidation(3), nullptr);
}

}  // namespace notice_reader_test
}  // namespace plumescout::client
