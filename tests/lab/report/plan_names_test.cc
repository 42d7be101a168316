// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/plan_names.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace plumescout::lab {
namespace plan_names_test {

// The names of the first `count` values of an enum.
template <typename Enum>
std::set<std::string> Names(int count) {
  std::set<std::string> names;
  for (int i = 0; i < count; ++i) names.insert(NameOf(static_cast<Enum>(i)));
  return names;
}

TEST(PlanNames, EveryValueHasANameOfItsOwn) {
  EXPECT_EQ(Names<MissionPhase>(5).size(), 5u);
  EXPECT_EQ(Names<GoalKind>(4).size(), 4u);
  EXPECT_EQ(Names<RejectionReason>(9).size(), 9u);
  EXPECT_EQ(Names<PlanEnd>(7).size(), 7u);
  EXPECT_EQ(Names<PathSource>(3).size(), 3u);
}

TEST(PlanNames, AValueThatIsNoneIsUnknown) {
  EXPECT_STREQ(NameOf(static_cast<GoalKind>(99)), "unknown");
}

}  // namespace plan_names_test
}  // namespace plumescout::lab
