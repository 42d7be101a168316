// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/clock_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/types/error_reason.h"

namespace plumescout::server {
namespace clock_gate_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kNow_ns = 1'800'000'000 * kSecond_ns;

class ClockGateTest : public testing::Test {
 protected:
  static ClockGate Gate(ClockGateOptions options = {}) {
    return ClockGate(options, [] { return kNow_ns; });
  }
  // What becomes of a sample of this time.
  static IncomingObservation Pass(ClockGate& gate, const RobotId& robot, std::int64_t time_ns,
                                  decltype(Observation::payload) payload = GasReading{}) {
    std::vector<IncomingObservation> batch;
    batch.push_back({{1, time_ns, {}, std::move(payload)}, absl::OkStatus()});
    gate.Pass(robot, batch);
    return batch[0];
  }
};

TEST_F(ClockGateTest, ASampleAheadOfTheClockIsRefusedWithItsLead) {
  ClockGate gate = Gate();
  EXPECT_TRUE(Pass(gate, "r1", kNow_ns + 5 * kSecond_ns).unreadable.ok());
  const absl::Status refused = Pass(gate, "r1", kNow_ns + 72'000 * kSecond_ns).unreadable;
  EXPECT_EQ(ErrorReason(refused), reason::kClockAhead);
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("it is by 72000 s"));
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("sample_time_ns = 18000720"));
}

TEST_F(ClockGateTest, ThePastPasses) {
  ClockGate gate = Gate();
  EXPECT_TRUE(Pass(gate, "r1", 0).unreadable.ok());
  EXPECT_TRUE(Pass(gate, "r1", -1).unreadable.ok()) << "for the mission to refuse";
  EXPECT_TRUE(Pass(gate, "r2", std::numeric_limits<std::int64_t>::min()).unreadable.ok());
}

TEST_F(ClockGateTest, NumbersWithoutSenseAreAheadToo) {
  ClockGate gate = Gate();
  EXPECT_FALSE(Pass(gate, "r1", std::numeric_limits<std::int64_t>::max()).unreadable.ok());
}

TEST_F(ClockGateTest, ARobotAheadIsNoExcuseForItself) {
  ClockGate gate = Gate();
  for (int step = 1; step < 4; ++step) {
    const std::int64_t lead_ns = 4 * step * kSecond_ns;
    EXPECT_EQ(Pass(gate, "r1", kNow_ns + lead_ns).unreadable.ok(), step == 1);
  }
}

TEST_F(ClockGateTest, OtherRobotsAreAsGoodAsTheServersClock) {
  ClockGate gate = Gate();
  ASSERT_TRUE(Pass(gate, "r1", kNow_ns + 4 * kSecond_ns).unreadable.ok());
  EXPECT_TRUE(Pass(gate, "r2", kNow_ns + 9 * kSecond_ns).unreadable.ok());
  EXPECT_FALSE(Pass(gate, "r2", kNow_ns + 10 * kSecond_ns).unreadable.ok());
}

TEST_F(ClockGateTest, RobotsThatAreWrongTogetherDoNotPushEachOtherOn) {
  ClockGate gate = Gate();
  for (int step = 1; step < 6; ++step) {
    const RobotId robot = step % 2 == 0 ? "r2" : "r1";
    EXPECT_EQ(Pass(gate, robot, kNow_ns + 5 * step * kSecond_ns).unreadable.ok(), step <= 2);
  }
}

TEST_F(ClockGateTest, ByArrivalASampleHasTheTimeOfTheServer) {
  ClockGate gate = Gate({.stamp_by_arrival = true});
  const IncomingObservation stamped = Pass(gate, "r1", kNow_ns + 6 * kSecond_ns);
  EXPECT_TRUE(stamped.unreadable.ok());
  EXPECT_EQ(stamped.observation.sample_time_ns, kNow_ns);
  EXPECT_EQ(Pass(gate, "r1", kNow_ns + kSecond_ns).observation.sample_time_ns,
            kNow_ns + kSecond_ns);
}

TEST_F(ClockGateTest, AGapLosesItsTimeAndStaysAGap) {
  ClockGate gate = Gate();
  const IncomingObservation gap = Pass(gate, "r1", kNow_ns + 6 * kSecond_ns, SequenceGap{1, 5});
  EXPECT_TRUE(gap.unreadable.ok());
  EXPECT_EQ(gap.observation.sample_time_ns, 0);
  EXPECT_EQ(LastSequence(gap.observation), 5);
}

TEST_F(ClockGateTest, ZeroLetsEverythingPass) {
  ClockGate gate = Gate({.max_lead = absl::ZeroDuration()});
  EXPECT_TRUE(Pass(gate, "r1", 2 * kNow_ns).unreadable.ok());
}

TEST_F(ClockGateTest, AClockThatIsAnHourOffPassesByMappedTime) {
  ClockGate gate = Gate();
  for (const std::int64_t offset_ns : {3600 * kSecond_ns, -3600 * kSecond_ns}) {
    std::vector<IncomingObservation> batch;
    batch.push_back({{1, kNow_ns - offset_ns, {}, GasReading{}}, absl::OkStatus()});
    batch.push_back({{2, kNow_ns - offset_ns + 6 * kSecond_ns, {}, GasReading{}}, {}});
    gate.Pass("r1", batch, ClockGate::Mapped{offset_ns, kNow_ns});
    EXPECT_TRUE(batch[0].unreadable.ok());
    EXPECT_EQ(batch[0].observation.sample_time_ns, kNow_ns - offset_ns) << "the robot's own";
    EXPECT_EQ(ErrorReason(batch[1].unreadable), reason::kClockAhead);
  }
}

TEST_F(ClockGateTest, OthersAreNoExcuseForWhoSaysWhenItSent) {
  ClockGate gate = Gate();
  ASSERT_TRUE(Pass(gate, "r1", kNow_ns + 4 * kSecond_ns).unreadable.ok());
  std::vector<IncomingObservation> batch;
  batch.push_back({{1, kNow_ns + 6 * kSecond_ns, {}, GasReading{}}, absl::OkStatus()});
  gate.Pass("r2", batch, ClockGate::Mapped{0, kNow_ns});
  EXPECT_FALSE(batch[0].unreadable.ok());
}

TEST_F(ClockGateTest, ByArrivalAMappedSampleHasTheTimeOfTheServer) {
  ClockGate gate = Gate({.stamp_by_arrival = true});
  std::vector<IncomingObservation> batch;
  batch.push_back({{1, kNow_ns + 60 * kSecond_ns, {}, GasReading{}}, absl::OkStatus()});
  gate.Pass("r1", batch, ClockGate::Mapped{-7 * kSecond_ns, kNow_ns});
  EXPECT_EQ(batch[0].observation.sample_time_ns, kNow_ns + 7 * kSecond_ns);
}

}  // namespace clock_gate_test
}  // namespace plumescout::server
