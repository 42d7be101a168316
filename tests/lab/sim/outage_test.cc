// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/outage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plumescout::lab {
namespace outage_test {

using ::testing::HasSubstr;

const std::vector<Outage> kAll = {{OutageKind::kLinkLost, 10.0, 5.0},
                                  {OutageKind::kSilent, 20.0, 5.0},
                                  {OutageKind::kLeaves, 30.0, 5.0},
                                  {OutageKind::kSilent, 40.0, std::nullopt}};

TEST(Outage, SaysHowTheLinkStands) {
  EXPECT_EQ(LinkAt(kAll, 9.9), LinkState::kUp);
  EXPECT_EQ(LinkAt(kAll, 10.0 - 1e-9), LinkState::kDown) << "rounding";
  EXPECT_EQ(LinkAt(kAll, 14.9), LinkState::kDown);
  EXPECT_EQ(LinkAt(kAll, 15.0), LinkState::kUp);
  EXPECT_EQ(LinkAt(kAll, 22.0), LinkState::kGone);
  EXPECT_EQ(LinkAt(kAll, 32.0), LinkState::kUp) << "it takes leave over it";
  EXPECT_EQ(LinkAt(kAll, 1e5), LinkState::kGone);
}

TEST(Outage, FindsTheNextAbsence) {
  EXPECT_EQ(NextAbsence(kAll, 0.0), &kAll[1]);
  EXPECT_EQ(NextAbsence(kAll, 24.9), &kAll[1]);
  EXPECT_EQ(NextAbsence(kAll, 25.0), &kAll[2]);
  EXPECT_EQ(NextAbsence(kAll, 1e5), &kAll[3]) << "for good";
  EXPECT_EQ(NextAbsence({}, 0.0), nullptr);
}

TEST(Outage, NamesWhatIsWrong) {
  EXPECT_TRUE(Validate(kAll).ok());
  const auto message = [](const std::vector<Outage>& outages) {
    return std::string(Validate(outages).message());
  };
  EXPECT_THAT(message({{OutageKind::kSilent, 0.0, 1.0}}), HasSubstr("outage.at_s = 0"));
  EXPECT_THAT(message({{OutageKind::kSilent, std::nan(""), 1.0}}), HasSubstr("outage.at_s = nan"));
  EXPECT_THAT(message({{OutageKind::kSilent, 1.0, 0.0}}), HasSubstr("outage.for_s = 0"));
  EXPECT_THAT(message({{OutageKind::kLinkLost, 1.0}}), HasSubstr("outage.for_s must be set"));
  EXPECT_THAT(message({kAll[1], kAll[0]}), HasSubstr("outage.at_s = 10 must be >= 25"));
  EXPECT_FALSE(Validate({kAll[3], {OutageKind::kLeaves, 1000.0}}).ok());
}

}  // namespace outage_test
}  // namespace plumescout::lab
