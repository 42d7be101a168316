// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/lease_book.h"

#include <gtest/gtest.h>

#include <map>

#include "core/types/error_reason.h"

namespace plumescout {
namespace lease_book_test {

constexpr std::int64_t kHold_ns = 10'000;
constexpr std::int64_t kForEver_ns = 1'000'000'000'000;

class LeaseBookTest : public testing::Test {
 protected:
  std::int64_t Take(const RobotId& robot, bool take_over = false) {
    const auto token = book_.Propose(robot, take_over, now_ns_);
    EXPECT_TRUE(token.ok()) << token.status();
    if (!token.ok()) return 0;
    book_.Grant(robot, *token, now_ns_);
    return *token;
  }
  StreamId Open(const RobotId& robot, std::int64_t token) {
    const auto opened = book_.OpenStream(robot, token, now_ns_);
    EXPECT_TRUE(opened.ok()) << opened.status();
    return opened.ok() ? opened->stream : 0;
  }
  bool Held() { return !book_.Propose("r1", false, now_ns_).ok(); }

  LeaseBook book_{kHold_ns, 100};
  std::int64_t now_ns_ = 5;
};

TEST_F(LeaseBookTest, TokensGrow) {
  const std::int64_t first = Take("r1");
  EXPECT_EQ(first, 100);
  EXPECT_EQ(Take("r2"), 101);
  EXPECT_EQ(Take("r1", /*take_over=*/true), 102);
}

TEST_F(LeaseBookTest, TokensThatOthersGaveAreNotGivenAgain) {
  book_.Grant("r1", 500, now_ns_);  // as after reading the events of an earlier life
  EXPECT_TRUE(book_.Check("r1", 500).ok());
  EXPECT_EQ(Take("r2"), 501);
}

TEST_F(LeaseBookTest, LeaseIsHeldForAWhileAfterItsLastUse) {
  const std::int64_t token = Take("r1");
  now_ns_ += kHold_ns - 1;
  ASSERT_TRUE(book_.Use("r1", token, now_ns_).ok());
  now_ns_ += kHold_ns - 1;
  const absl::Status refused = book_.Propose("r1", false, now_ns_).status();
  EXPECT_EQ(ErrorReason(refused), reason::kLeaseHeld);
  EXPECT_EQ(RetryAfter_ns(refused), 1);
  now_ns_ += 1;
  EXPECT_FALSE(Held());
}

TEST_F(LeaseBookTest, TimeIsLeftUntilItRunsOutUnlessAStreamHoldsIt) {
  EXPECT_EQ(book_.TimeLeft_ns("r1", now_ns_), 0);
  const std::int64_t token = Take("r1");
  EXPECT_EQ(book_.TimeLeft_ns("r1", now_ns_), kHold_ns);
  const StreamId stream = Open("r1", token);
  EXPECT_EQ(book_.TimeLeft_ns("r1", now_ns_), std::nullopt);
  now_ns_ += 7;
  book_.CloseStream("r1", stream, now_ns_);
  now_ns_ += kHold_ns - 1;
  EXPECT_EQ(book_.TimeLeft_ns("r1", now_ns_), 1);
  now_ns_ += 1;
  EXPECT_EQ(book_.TimeLeft_ns("r1", now_ns_), 0);
}

TEST_F(LeaseBookTest, LookingIsNoUse) {
  const std::int64_t token = Take("r1");
  now_ns_ += kHold_ns;
  EXPECT_TRUE(book_.Check("r1", token).ok());
  EXPECT_FALSE(Held());
}

TEST_F(LeaseBookTest, LeaseThatRanOutHoldsUntilAnotherTakesIt) {
  const std::int64_t token = Take("r1");
  now_ns_ += kForEver_ns;
  EXPECT_TRUE(book_.Use("r1", token, now_ns_).ok());
  EXPECT_TRUE(Held());
}

TEST_F(LeaseBookTest, WhoLeftHasNeitherLeaseNorStream) {
  const std::int64_t token = Take("r1");
  const StreamId stream = Open("r1", token);
  EXPECT_EQ(book_.Remove("r1"), stream);
  EXPECT_EQ(ErrorReason(book_.Check("r1", token)), reason::kRobotNotFound);
  EXPECT_EQ(book_.robot_count(), 0);
  EXPECT_EQ(book_.Remove("r1"), 0);
  EXPECT_FALSE(Held());
  EXPECT_GT(Take("r1"), token);
}

TEST_F(LeaseBookTest, OpenStreamHoldsTheLeaseHoweverLong) {
  const StreamId stream = Open("r1", Take("r1"));
  now_ns_ += kForEver_ns;
  EXPECT_EQ(RetryAfter_ns(book_.Propose("r1", false, now_ns_).status()), kHold_ns);
  book_.CloseStream("r1", stream, now_ns_);
  EXPECT_TRUE(Held());
  now_ns_ += kHold_ns;
  EXPECT_FALSE(Held());
}

TEST_F(LeaseBookTest, ProposalAloneChangesNothing) {
  const std::int64_t token = Take("r1");
  const StreamId stream = Open("r1", token);
  const auto proposed = book_.Propose("r1", /*take_over=*/true, now_ns_);
  ASSERT_TRUE(proposed.ok());
  EXPECT_TRUE(book_.CheckStream("r1", token, stream).ok());
  EXPECT_EQ(book_.Propose("r1", /*take_over=*/true, now_ns_).value(), *proposed);
  EXPECT_EQ(book_.robot_count(), 1);
}

TEST_F(LeaseBookTest, TakeOverEndsTheOldStreamAndFencesItsToken) {
  const std::int64_t token = Take("r1");
  const StreamId stream = Open("r1", token);
  EXPECT_EQ(book_.Grant("r1", token + 1, now_ns_), stream);
  EXPECT_EQ(ErrorReason(book_.Use("r1", token, now_ns_)), reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(book_.OpenStream("r1", token, now_ns_).status()), reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(book_.CheckStream("r1", token, stream)), reason::kLeaseSuperseded);
  EXPECT_EQ(book_.Grant("r1", token + 2, now_ns_), 0);
}

TEST_F(LeaseBookTest, FencedTokenIsNoUse) {
  const std::int64_t token = Take("r1");
  Take("r1", /*take_over=*/true);
  now_ns_ += kHold_ns;
  EXPECT_FALSE(book_.Use("r1", token, now_ns_).ok());
  EXPECT_FALSE(Held());
}

TEST_F(LeaseBookTest, NewerStreamOfTheSameLeaseReplacesTheOlder) {
  const std::int64_t token = Take("r1");
  const StreamId older = Open("r1", token);
  const auto newer = book_.OpenStream("r1", token, now_ns_);
  ASSERT_TRUE(newer.ok());
  EXPECT_EQ(newer->replaced, older);
  EXPECT_EQ(ErrorReason(book_.CheckStream("r1", token, older)), reason::kStreamReplaced);
  book_.CloseStream("r1", older, now_ns_);  // the late end of the older is no end of the lease
  now_ns_ += kForEver_ns;
  EXPECT_TRUE(book_.CheckStream("r1", token, newer->stream).ok());
  EXPECT_TRUE(Held());
}

TEST_F(LeaseBookTest, UnknownRobotIsNotFound) {
  EXPECT_EQ(ErrorReason(book_.Check("r1", 100)), reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(book_.OpenStream("r1", 100, now_ns_).status()), reason::kRobotNotFound);
  EXPECT_EQ(book_.robot_count(), 0);
}

TEST_F(LeaseBookTest, ClosingAllStreamsLeavesTheLeases) {
  const std::int64_t token = Take("r1");
  const StreamId stream = Open("r1", token);
  book_.CloseAllStreams();
  EXPECT_EQ(ErrorReason(book_.CheckStream("r1", token, stream)), reason::kStreamReplaced);
  EXPECT_TRUE(book_.Check("r1", token).ok());
}

TEST_F(LeaseBookTest, BookAtAnInstantIsTheSameBook) {
  LeasesAt(book_, now_ns_).Grant("r1", 100);
  EXPECT_FALSE(LeasesAt(book_, now_ns_ + kHold_ns - 1).Propose("r1", false).ok());
  EXPECT_EQ(LeasesAt(book_, now_ns_ + kHold_ns).Propose("r1", false).value(), 101);
}

TEST_F(LeaseBookTest, AReleasedLeaseIsFreeAtOnceAndWritesNothingMore) {
  const std::int64_t token = Take("r1");
  const StreamId stream = Open("r1", token);
  EXPECT_EQ(book_.Standing("r1", now_ns_), (LeaseStanding{true, true}));
  EXPECT_EQ(ErrorReason(book_.Release("r1", token + 1).status()), reason::kLeaseSuperseded);
  EXPECT_EQ(book_.Release("r1", token).value(), stream);
  EXPECT_EQ(book_.Standing("r1", now_ns_), LeaseStanding{});
  EXPECT_EQ(ErrorReason(book_.Use("r1", token, now_ns_)), reason::kLeaseSuperseded);
  EXPECT_FALSE(Held());
  const std::int64_t newer = Take("r1");
  EXPECT_GT(newer, token);
  EXPECT_TRUE(book_.Use("r1", newer, now_ns_).ok());
}

TEST_F(LeaseBookTest, AnybodyMayReleaseTheLeaseOfARobotThatDied) {
  Take("r1");
  EXPECT_TRUE(book_.Release("r1", std::nullopt).ok());
  EXPECT_FALSE(Held());
  EXPECT_EQ(ErrorReason(book_.Release("r2", std::nullopt).status()), reason::kRobotNotFound);
}

TEST_F(LeaseBookTest, TokensThatWereGivenUpAreToldUntilThereAreNewer) {
  Take("r1");
  const std::int64_t token = Take("r2");
  EXPECT_TRUE(book_.Released().empty());
  EXPECT_TRUE(book_.Release("r2", token).ok());
  EXPECT_EQ(book_.Released(), (std::map<RobotId, std::int64_t>{{"r2", token}}));
  Take("r2");
  EXPECT_TRUE(book_.Released().empty());
}

TEST_F(LeaseBookTest, StandingTellsWhetherALeaseIsHeld) {
  EXPECT_EQ(book_.Standing("r1", now_ns_), LeaseStanding{});
  Take("r1");
  EXPECT_EQ(book_.Standing("r1", now_ns_ + kHold_ns - 1), (LeaseStanding{true, false}));
  EXPECT_EQ(book_.Standing("r1", now_ns_ + kHold_ns), LeaseStanding{});
}

TEST(FirstLeaseTokenTest, TokensFitIntoADoubleForEver) {
  for (const std::uint64_t bits :
       {std::uint64_t{0}, std::uint64_t{0x1234'5678'9abc'def0}, ~std::uint64_t{0}}) {
    const std::int64_t token = FirstLeaseToken(bits);
    EXPECT_GT(token, 0);
    EXPECT_LE(token, kLeaseTokenEnd / 2);
    EXPECT_EQ(static_cast<std::int64_t>(static_cast<double>(token)), token);
  }
  EXPECT_NE(FirstLeaseToken(1), FirstLeaseToken(2));
}

}  // namespace lease_book_test
}  // namespace plumescout
