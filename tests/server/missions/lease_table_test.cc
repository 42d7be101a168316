// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/lease_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/types/error_reason.h"

namespace plumescout::server {
namespace lease_table_test {

class LeaseTableTest : public testing::Test {
 protected:
  std::int64_t Take(const RobotId& robot, bool take_over = false) {
    const auto token = table_.Propose(robot, take_over);
    EXPECT_TRUE(token.ok()) << token.status();
    table_.Grant(robot, *token);
    return *token;
  }
  bool Held() { return !table_.Propose("r1", false).ok(); }

  absl::Status ended_;
  LeaseTable::EndStream end_ = [this](const absl::Status& status) { ended_ = status; };
  SteadyTime now_;
  LeaseTable table_{absl::Seconds(10), 100, [this] { return now_; }};
};

TEST_F(LeaseTableTest, LeaseIsHeldByTheServersClock) {
  const std::int64_t token = Take("r1");
  now_ += std::chrono::seconds(9);
  EXPECT_TRUE(table_.Use("r1", token).ok());
  now_ += std::chrono::milliseconds(9999);
  const absl::Status refused = table_.Propose("r1", false).status();
  EXPECT_EQ(ErrorReason(refused), reason::kLeaseHeld);
  EXPECT_EQ(RetryAfter_ns(refused), 1'000'000);
  now_ += std::chrono::milliseconds(1);
  EXPECT_FALSE(Held());
}

TEST_F(LeaseTableTest, TimeIsLeftUntilTheLeaseRunsOut) {
  EXPECT_EQ(table_.TimeLeft("r1"), absl::ZeroDuration()) << "nobody has one";
  const std::int64_t token = Take("r1");
  now_ += std::chrono::seconds(3);
  EXPECT_EQ(table_.TimeLeft("r1"), absl::Seconds(7));
  ASSERT_TRUE(table_.OpenStream("r1", token, end_).ok());
  EXPECT_EQ(table_.TimeLeft("r1"), absl::InfiniteDuration());
}

TEST_F(LeaseTableTest, RemovedRobotIsUnknownAndItsStreamEnds) {
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, end_).ok());
  table_.Remove("r1");
  EXPECT_EQ(ended_.message().find("ROBOT_NOT_FOUND"), 0u);
  EXPECT_TRUE(absl::IsNotFound(table_.Use("r1", token)));
  EXPECT_EQ(table_.robot_count(), 0);
  table_.Remove("r1");
  EXPECT_GT(Take("r1"), token) << "nobody holds it";
}

TEST_F(LeaseTableTest, OpenStreamHoldsTheLeaseUntilItIsClosed) {
  const std::int64_t token = Take("r1");
  const auto stream = table_.OpenStream("r1", token, end_);
  ASSERT_TRUE(stream.ok());
  now_ += std::chrono::hours(1);
  EXPECT_TRUE(Held());
  table_.CloseStream("r1", *stream);
  now_ += std::chrono::seconds(10);
  EXPECT_FALSE(Held());
  EXPECT_TRUE(ended_.ok());
}

TEST_F(LeaseTableTest, TakeOverEndsTheOldStream) {
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, end_).ok());
  Take("r1", /*take_over=*/true);
  EXPECT_EQ(ErrorReason(ended_), reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(table_.OpenStream("r1", token, end_).status()), reason::kLeaseSuperseded);
}

TEST_F(LeaseTableTest, NewerStreamOfTheSameLeaseEndsTheOlder) {
  const std::int64_t token = Take("r1");
  const auto older = table_.OpenStream("r1", token, end_);
  ASSERT_TRUE(table_.OpenStream("r1", token, nullptr).ok());
  EXPECT_EQ(ErrorReason(ended_), reason::kStreamReplaced);
  table_.CloseStream("r1", *older);  // the late end of the older is no end of the lease
  now_ += std::chrono::hours(1);
  EXPECT_TRUE(Held());
}

TEST_F(LeaseTableTest, RobotsAreCounted) {
  EXPECT_EQ(table_.robot_count(), 0);
  EXPECT_TRUE(absl::IsNotFound(table_.Use("r1", 100)));
  Take("r1");
  Take("r2");
  EXPECT_EQ(table_.robot_count(), 2);
}

TEST_F(LeaseTableTest, EndAllReachesEveryOpenStreamOnce) {
  std::vector<absl::Status> ended;
  const auto end = [&](const absl::Status& status) { ended.push_back(status); };
  ASSERT_TRUE(table_.OpenStream("r1", Take("r1"), end).ok());
  ASSERT_TRUE(table_.OpenStream("r2", Take("r2"), end).ok());
  const auto closed = table_.OpenStream("r3", Take("r3"), end);
  table_.CloseStream("r3", *closed);
  table_.EndAll(absl::UnavailableError("over"));
  table_.EndAll(absl::UnavailableError("over"));
  EXPECT_THAT(ended,
              testing::ElementsAre(absl::UnavailableError("over"), absl::UnavailableError("over")));
}

TEST_F(LeaseTableTest, AReleasedLeaseEndsItsStreamAndIsFree) {
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, end_).ok());
  EXPECT_EQ(table_.Standing("r1"), (LeaseStanding{true, true}));
  ASSERT_TRUE(table_.Release("r1", token).ok());
  EXPECT_EQ(ErrorReason(ended_), reason::kLeaseSuperseded);
  EXPECT_EQ(table_.Standing("r1"), LeaseStanding{});
  EXPECT_FALSE(Held());
  EXPECT_EQ(table_.Released().at("r1"), token);
  EXPECT_TRUE(absl::IsNotFound(table_.Release("r2", std::nullopt)));
}

}  // namespace lease_table_test
}  // namespace plumescout::server
