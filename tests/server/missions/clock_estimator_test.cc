// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/clock_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/types/rng.h"

namespace plumescout::server {
namespace clock_estimator_test {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
constexpr std::int64_t kBegin_ns = 1'800'000'000 * kSecond_ns;

// A robot that sends a batch ten times a second over a link that delays.
class Link {
 public:
  explicit Link(std::int64_t offset_ns) : offset_ns_(offset_ns) {}

  // The estimate after so long, of batches that take 5 ms and up to `jitter_ns` more.
  std::int64_t Run(double duration_s, std::int64_t jitter_ns, double drift = 0.0) {
    std::int64_t estimate_ns = 0;
    for (int k = 0; k < std::lround(10.0 * duration_s); ++k) {
      now_ns_ += kSecond_ns / 10;
      offset_ns_ += std::llround(drift * static_cast<double>(kSecond_ns / 10));
      estimate_ns = Send(5 * kMillisecond_ns + (jitter_ns == 0 ? 0 : Jitter(jitter_ns)));
    }
    return estimate_ns;
  }
  std::int64_t Send(std::int64_t delay_ns) {
    return estimator_.Note(now_ns_ - offset_ns_, now_ns_ + delay_ns);
  }
  void Wait(double duration_s) { now_ns_ += std::llround(duration_s * 1e9); }
  void Set(std::int64_t offset_ns) { offset_ns_ = offset_ns; }
  std::int64_t offset_ns() const { return offset_ns_; }

 private:
  std::int64_t Jitter(std::int64_t most_ns) {
    return static_cast<std::int64_t>(rng_.Uniform01() * static_cast<double>(most_ns));
  }

  Rng rng_{7};
  ClockEstimator estimator_;
  std::int64_t now_ns_ = kBegin_ns;
  std::int64_t offset_ns_;
};

TEST(ClockEstimatorTest, TheFirstBatchTellsTheOffset) {
  for (const std::int64_t offset_ns : {std::int64_t{0}, kHour_ns, -kHour_ns, kBegin_ns}) {
    Link link(offset_ns);
    EXPECT_EQ(link.Run(0.1, 0), offset_ns + 5 * kMillisecond_ns);
  }
}

TEST(ClockEstimatorTest, JitterMakesItBetterNotWorse) {
  Link link(kHour_ns);
  EXPECT_NEAR(static_cast<double>(link.Run(30.0, 200 * kMillisecond_ns) - kHour_ns), 5e6, 3e6);
  EXPECT_NEAR(static_cast<double>(link.Run(300.0, 200 * kMillisecond_ns) - kHour_ns), 5e6, 3e6);
}

TEST(ClockEstimatorTest, ADriftOf100PpmIsFollowed) {
  for (const double drift : {1e-4, -1e-4}) {
    Link link(-kHour_ns);
    for (int minute = 0; minute < 20; ++minute) {
      const std::int64_t estimate_ns = link.Run(60.0, 50 * kMillisecond_ns, drift);
      EXPECT_LT(std::abs(estimate_ns - link.offset_ns()), 15 * kMillisecond_ns);
    }
  }
}

TEST(ClockEstimatorTest, AnOutageAndTheBacklogAfterItChangeNothing) {
  Link link(kHour_ns);
  link.Run(20.0, 0);
  link.Wait(30.0);
  for (int k = 0; k < 20; ++k) {  // a link that is full delays
    EXPECT_LE(std::abs(link.Send(900 * kMillisecond_ns) - kHour_ns), 5 * kMillisecond_ns);
    link.Wait(0.05);
  }
  link.Wait(3600.0);
  EXPECT_LE(std::abs(link.Run(0.1, 0) - kHour_ns), 5 * kMillisecond_ns);
}

TEST(ClockEstimatorTest, AClockThatIsSetIsFollowedAtOnce) {
  for (const std::int64_t offset_ns : {kHour_ns, -kHour_ns, 3 * kSecond_ns, -3 * kSecond_ns}) {
    Link link(0);
    link.Run(20.0, 0);
    link.Set(offset_ns);
    EXPECT_EQ(link.Run(0.1, 0), offset_ns + 5 * kMillisecond_ns) << offset_ns;
  }
}

TEST(ClockEstimatorTest, AClockThatWasSetBackDuringAnOutageIsFollowedAfterThreeSeconds) {
  Link link(0);
  link.Run(20.0, 0);
  link.Wait(2.0 * 3600.0);
  link.Set(kHour_ns);  // its times have not gone back
  EXPECT_EQ(link.Run(2.9, 0), 5 * kMillisecond_ns);
  EXPECT_EQ(link.Run(0.3, 0), kHour_ns + 5 * kMillisecond_ns);
}

TEST(ClockEstimatorTest, ALinkThatIsSlowForAMomentIsNoClockThatWasSet) {
  Link link(0);
  link.Run(20.0, 0);
  for (int k = 0; k < 25; ++k) {
    link.Wait(0.1);
    EXPECT_EQ(link.Send(2 * kSecond_ns), 5 * kMillisecond_ns);
  }
  EXPECT_EQ(link.Run(1.0, 0), 5 * kMillisecond_ns);
}

TEST(ClockEstimatorTest, AnArrivalThatNobodySawNeverMakesTheOffsetGreater) {
  ClockEstimator estimator;
  constexpr std::int64_t kDelay_ns = 5 * kMillisecond_ns;
  EXPECT_EQ(estimator.Note(kBegin_ns, kBegin_ns + kDelay_ns, true), kDelay_ns) << "the first tells";
  for (int k = 1; k <= 100; ++k) {
    const std::int64_t sent_ns = kBegin_ns + k * kSecond_ns;
    EXPECT_EQ(estimator.Note(sent_ns, sent_ns + 4 * kSecond_ns, true), kDelay_ns) << k;
  }
  const std::int64_t sent_ns = kBegin_ns + 101 * kSecond_ns;
  EXPECT_EQ(estimator.Note(sent_ns, sent_ns + kMillisecond_ns, true), kMillisecond_ns);
  EXPECT_EQ(estimator.Note(sent_ns - kHour_ns, sent_ns, true), kHour_ns) << "it was set back";
}

TEST(ClockEstimatorTest, ATimeOnTheWireIsTakenOffByTheNextBatchAndIsNoClockThatWasSet) {
  ClockEstimator estimator;
  constexpr std::int64_t kDelay_ns = 5 * kMillisecond_ns;
  estimator.Note(kBegin_ns, kBegin_ns + kDelay_ns);
  const std::int64_t set_back_ns = kBegin_ns - kHour_ns;
  EXPECT_EQ(estimator.Note(set_back_ns, kBegin_ns + 3 * kSecond_ns, true),
            kHour_ns + 3 * kSecond_ns);
  EXPECT_FALSE(estimator.lowered_itself()) << "the clock was set";
  EXPECT_EQ(estimator.Note(set_back_ns + kSecond_ns, kBegin_ns + 3 * kSecond_ns, true),
            kHour_ns + 2 * kSecond_ns);
  EXPECT_EQ(estimator.Note(set_back_ns + 4 * kSecond_ns, kBegin_ns + 4 * kSecond_ns + kDelay_ns),
            kHour_ns + kDelay_ns);
  EXPECT_TRUE(estimator.lowered_itself());
  EXPECT_EQ(estimator.Note(kBegin_ns + 5 * kSecond_ns, kBegin_ns + 5 * kSecond_ns + kDelay_ns),
            kDelay_ns);
  EXPECT_FALSE(estimator.lowered_itself()) << "it was set once more";
}

// Calls of one robot side by side may change places.
TEST(ClockEstimatorTest, ArrivalsOutOfOrderForgetNothing) {
  ClockEstimator estimator;
  EXPECT_EQ(estimator.Note(kBegin_ns, kBegin_ns + kMillisecond_ns), kMillisecond_ns);
  static_assert(kBegin_ns % (5 * kSecond_ns) == 0, "where a span begins");
  for (int k = 0; k < 100; ++k) {
    const std::int64_t arrived_ns = kBegin_ns + 5 * kSecond_ns - (k % 2) * kMillisecond_ns;
    EXPECT_EQ(estimator.Note(arrived_ns - 900 * kMillisecond_ns, arrived_ns), kMillisecond_ns) << k;
  }
}

TEST(ClockEstimatorTest, TimesWithoutSenseDoNoHarm) {
  ClockEstimator estimator;
  constexpr std::int64_t kLast_ns = std::int64_t{1} << 62;
  for (const std::int64_t sent_ns : {kLast_ns, std::int64_t{1}, kLast_ns, kBegin_ns}) {
    EXPECT_EQ(estimator.Note(sent_ns, kBegin_ns), kBegin_ns - sent_ns);
  }
}

}  // namespace clock_estimator_test
}  // namespace plumescout::server
