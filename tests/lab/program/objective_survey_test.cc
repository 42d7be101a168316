// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/objective_survey.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace objective_survey_test {

const ObjectiveOptions kAsked{.kind = ObjectiveKind::kConfirmClean, .threshold_ppm = 10.0};

// 100 x 60 cells, the southern row of which is wall.
MapSnapshot MapOfAHall() {
  MapSnapshot map;
  map.occupancy = Grid<CellState>(GridGeometry{1.0, 2.0, 0.5, 100, 60}, CellState::kFree);
  for (int x = 0; x < 100; ++x) map.occupancy[Cell{x, 0}] = CellState::kOccupied;
  map.objective = ObjectiveStatus{.state = ObjectiveState::kMet, .since_ns = 12'500'000'000};
  map.objective_explanation = "It is met.";
  return map;
}

// West of x = 11 m it is decided.
std::vector<GasAtPlace> Answer(const std::vector<Point2>& places) {
  std::vector<GasAtPlace> gas(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    gas[i].verdict =
        places[i].x_m < 11.0 ? ObjectiveVerdict::kDecided : ObjectiveVerdict::kUndecided;
  }
  return gas;
}

TEST(SurveyObjective, AsksOfEveryFreeCellAFewAtATime) {
  std::vector<std::size_t> asked;
  const auto outcome =
      SurveyObjective(kAsked, MapOfAHall(), 2'500'000'000, [&](const std::vector<Point2>& places) {
        asked.push_back(places.size());
        return Answer(places);
      });
  ASSERT_TRUE(outcome.ok()) << outcome.status();
  ASSERT_TRUE(outcome->has_value());
  EXPECT_EQ(asked, (std::vector<std::size_t>{kMaxPlaces, 5900 - kMaxPlaces}));
  EXPECT_EQ((*outcome)->since_s, 10.0);
  EXPECT_EQ((*outcome)->explanation, "It is met.");
  EXPECT_EQ((*outcome)->status.state, ObjectiveState::kMet);
  const Grid<ObjectiveVerdict>& verdicts = (*outcome)->verdicts;
  EXPECT_EQ((verdicts[Cell{3, 0}]), ObjectiveVerdict::kDoesNotCount);
  EXPECT_EQ((verdicts[Cell{19, 59}]), ObjectiveVerdict::kDecided);
  EXPECT_EQ((verdicts[Cell{20, 59}]), ObjectiveVerdict::kUndecided);
}

TEST(SurveyObjective, OfACompleteMapNothingIsAsked) {
  const AskGas never = [](const std::vector<Point2>&) {
    return absl::StatusOr<std::vector<GasAtPlace>>(absl::InternalError("it was asked"));
  };
  const auto complete = SurveyObjective({}, MapOfAHall(), 0, never);
  ASSERT_TRUE(complete.ok()) << complete.status();
  EXPECT_FALSE(complete->has_value());
  MapSnapshot map = MapOfAHall();
  map.objective.reset();
  EXPECT_TRUE(SurveyObjective(kAsked, map, 0, never).ok());
}

TEST(SurveyObjective, WhatTheServiceSaysAgainstItIsTold) {
  EXPECT_EQ(SurveyObjective(kAsked, MapOfAHall(), 0,
                            [](const std::vector<Point2>&) {
                              return absl::StatusOr<std::vector<GasAtPlace>>(
                                  absl::UnavailableError("gone"));
                            })
                .status()
                .code(),
            absl::StatusCode::kUnavailable);
  EXPECT_EQ(
      SurveyObjective(kAsked, MapOfAHall(), 0,
                      [](const std::vector<Point2>&) {
                        return absl::StatusOr<std::vector<GasAtPlace>>(std::vector<GasAtPlace>(1));
                      })
          .status()
          .code(),
      absl::StatusCode::kInternal);
}

}  // namespace objective_survey_test
}  // namespace plumescout::lab
