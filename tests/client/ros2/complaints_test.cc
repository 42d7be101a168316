// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/complaints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace plumescout::client {
namespace complaints_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(Complaints, SaysOfEachThingEveryFiveSecondsAndHowOftenItWas) {
  std::vector<std::string> said;
  Complaints complaints([&said](const std::string& text) { said.push_back(text); });
  complaints.Add("scan", "no angles", 0);
  complaints.Add("scan", "no angles", kSecond_ns);
  complaints.Add("gas", "AMP", kSecond_ns);
  complaints.Add("scan", "no ranges", 4 * kSecond_ns);
  complaints.Add("scan", "no angles", 5 * kSecond_ns);
  complaints.Add("scan", "no ranges", 11 * kSecond_ns);
  EXPECT_THAT(said, ::testing::ElementsAre("scan: no angles", "gas: AMP",
                                           "scan: no angles (and 2 before)", "scan: no ranges"));
}

}  // namespace complaints_test
}  // namespace plumescout::client
