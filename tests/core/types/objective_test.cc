// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/objective.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumescout {
namespace objective_test {

using ::testing::HasSubstr;

ObjectiveOptions Kind(ObjectiveKind kind) { return {.kind = kind, .threshold_ppm = 10.0}; }

ObjectiveStatus In(ObjectiveState state) {
  return {state, 0.975, 2.5, 1, Point2{3, 4}, 34.2, 4.0, Point2{5, 6}, 0};
}

TEST(Describe, SaysWhatIsSoAndHowSureThatIs) {
  const ObjectiveStatus met = In(ObjectiveState::kMet);
  EXPECT_EQ(Describe(met, Kind(ObjectiveKind::kConfirmClean)),
            "The objective is met: clean: nowhere more than 10 ppm, with a confidence of 97.5 %.");
  EXPECT_THAT(Describe(met, Kind(ObjectiveKind::kMapAboveThreshold)),
              HasSubstr("more than 10 ppm is known to within 1 m"));
  EXPECT_THAT(Describe(met, Kind(ObjectiveKind::kFindSources)), HasSubstr("at (5.0, 6.0)"));
}

TEST(Describe, SaysWhatSpeaksAgainstIt) {
  const ObjectiveStatus refuted = In(ObjectiveState::kRefuted);
  EXPECT_THAT(Describe(refuted, Kind(ObjectiveKind::kConfirmClean)),
              HasSubstr("not clean: 34.2 ppm at (3.0, 4.0)"));
  EXPECT_THAT(Describe(refuted, Kind(ObjectiveKind::kFindSources)), HasSubstr("no source"));
}

TEST(Describe, SaysWhatIsLeft) {
  const ObjectiveOptions clean = Kind(ObjectiveKind::kConfirmClean);
  EXPECT_THAT(
      Describe(In(ObjectiveState::kPursued), clean),
      HasSubstr("2.5 m\u00B2 are undecided, most of all at (3.0, 4.0), and 1 frontier of the "
                "map is open."));
  EXPECT_THAT(Describe(In(ObjectiveState::kCannotBeMet), clean), HasSubstr("ended before"));
  EXPECT_THAT(Describe(ObjectiveStatus(), clean), HasSubstr("nothing is known yet"));
}

TEST(IsConcluded, OnlyOnceThereIsNothingToLearn) {
  EXPECT_TRUE(IsConcluded(In(ObjectiveState::kMet)));
  EXPECT_TRUE(IsConcluded(In(ObjectiveState::kRefuted)));
  EXPECT_FALSE(IsConcluded(In(ObjectiveState::kPursued)));
  EXPECT_FALSE(IsConcluded(In(ObjectiveState::kCannotBeMet)));
}

}  // namespace objective_test
}  // namespace plumescout
