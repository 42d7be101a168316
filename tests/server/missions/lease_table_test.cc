// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/lease_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "proto/convert/status.h"

namespace plumescout::server {
namespace {

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

TEST_F(LeaseTableTest, TokensGrow) {
  const std::int64_t first = Take("r1");
  EXPECT_GE(first, 100);
  EXPECT_GT(Take("r1", /*take_over=*/true), first);
}

TEST_F(LeaseTableTest, LeaseIsHeldForAWhileAfterItsLastUse) {
  const std::int64_t token = Take("r1");
  now_ += std::chrono::seconds(9);
  EXPECT_TRUE(table_.Check("r1", token).ok());
  now_ += std::chrono::milliseconds(9999);
  const absl::Status refused = table_.Propose("r1", false).status();
  EXPECT_EQ(refused.message().find("LEASE_HELD"), 0u);
  EXPECT_EQ(RetryDelay(refused), absl::Milliseconds(1));
  now_ += std::chrono::milliseconds(1);
  EXPECT_FALSE(Held());
}

TEST_F(LeaseTableTest, RemovedRobotIsUnknownAndItsStreamEnds) {
  const int stream = 0;
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, &stream, end_).ok());
  table_.Remove("r1");
  EXPECT_EQ(ended_.message().find("ROBOT_NOT_FOUND"), 0u);
  EXPECT_TRUE(absl::IsNotFound(table_.Check("r1", token)));
  EXPECT_EQ(table_.robot_count(), 0);
  table_.Remove("r1");
  EXPECT_GT(Take("r1"), token) << "nobody holds it";
}

TEST_F(LeaseTableTest, OpenStreamHoldsTheLeaseHoweverLong) {
  const int stream = 0;
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, &stream, end_).ok());
  now_ += std::chrono::hours(1);
  EXPECT_TRUE(Held());
  table_.CloseStream("r1", &stream);
  EXPECT_TRUE(Held());
  now_ += std::chrono::seconds(10);
  EXPECT_FALSE(Held());
}

TEST_F(LeaseTableTest, ProposalAloneChangesNothing) {
  const int stream = 0;
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, &stream, end_).ok());
  ASSERT_TRUE(table_.Propose("r1", /*take_over=*/true).ok());
  EXPECT_TRUE(table_.Check("r1", token).ok());
  EXPECT_TRUE(ended_.ok());
}

TEST_F(LeaseTableTest, TakeOverEndsTheOldStreamAndFencesItsToken) {
  const int stream = 0;
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, &stream, end_).ok());
  Take("r1", /*take_over=*/true);
  EXPECT_EQ(ended_.message().find("LEASE_SUPERSEDED"), 0u);
  EXPECT_EQ(table_.Check("r1", token).message().find("LEASE_SUPERSEDED"), 0u);
  EXPECT_FALSE(table_.OpenStream("r1", token, &stream, end_).ok());
}

TEST_F(LeaseTableTest, NewerStreamOfTheSameLeaseReplacesTheOlder) {
  const int older = 0;
  const int newer = 0;
  const std::int64_t token = Take("r1");
  ASSERT_TRUE(table_.OpenStream("r1", token, &older, end_).ok());
  ASSERT_TRUE(table_.OpenStream("r1", token, &newer, nullptr).ok());
  EXPECT_EQ(ended_.message().find("STREAM_REPLACED"), 0u);
  table_.CloseStream("r1", &older);  // the late end of the older is no end of the lease
  now_ += std::chrono::hours(1);
  EXPECT_TRUE(Held());
}

TEST_F(LeaseTableTest, UnknownRobotIsNotFound) {
  EXPECT_TRUE(absl::IsNotFound(table_.Check("r1", 100)));
  EXPECT_EQ(table_.robot_count(), 0);
}

TEST_F(LeaseTableTest, EndAllReachesEveryStream) {
  std::vector<absl::Status> ended;
  const int streams[2] = {};
  const auto end = [&](const absl::Status& status) { ended.push_back(status); };
  ASSERT_TRUE(table_.OpenStream("r1", Take("r1"), &streams[0], end).ok());
  ASSERT_TRUE(table_.OpenStream("r2", Take("r2"), &streams[1], end).ok());
  table_.EndAll(absl::UnavailableError("over"));
  EXPECT_THAT(ended,
              testing::ElementsAre(absl::UnavailableError("over"), absl::UnavailableError("over")));
}

}  // namespace
}  // namespace plumescout::server
