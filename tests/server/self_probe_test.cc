// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/self_probe.h"

#include <gtest/gtest.h>

#include <atomic>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"

namespace plumescout::server {
namespace self_probe_test {

constexpr absl::Duration kPatience = absl::Seconds(60);
const SelfProbe::Options kQuick = {.period = absl::Milliseconds(1), .failures = 3};

void Unexpected(const absl::Status& status) { FAIL() << status; }

TEST(SelfProbeTest, FailuresInARowMeanOutOfReach) {
  int asked = 0;
  absl::Notification told;
  absl::Status why;
  {
    const SelfProbe probe(
        kQuick, [&] { return absl::UnavailableError(absl::StrCat("failure ", ++asked)); },
        [&](const absl::Status& status) {
          why = status;
          told.Notify();
        });
    ASSERT_TRUE(told.WaitForNotificationWithTimeout(kPatience));
  }
  EXPECT_EQ(asked, 3);  // and never again
  EXPECT_EQ(why, absl::UnavailableError("failure 3"));
}

TEST(SelfProbeTest, AnAnswerBetweenFailuresMeansReach) {
  std::atomic<int> asked = 0;
  absl::Notification enough;
  const SelfProbe probe(
      kQuick,
      [&] {
        const int number = ++asked;
        if (number == 30) enough.Notify();
        return number % 3 == 0 ? absl::OkStatus() : absl::UnavailableError("");
      },
      Unexpected);
  EXPECT_TRUE(enough.WaitForNotificationWithTimeout(kPatience));
}

TEST(SelfProbeTest, ItEndsWithoutWaitingForThePeriod) {
  const SelfProbe probe(
      {.period = absl::Hours(1)}, [] { return absl::OkStatus(); }, Unexpected);
}

}  // namespace self_probe_test
}  // namespace plumescout::server
