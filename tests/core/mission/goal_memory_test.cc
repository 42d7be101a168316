// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/goal_memory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout {
namespace goal_memory_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr Point2 kPlace = {1.05, 1.05};  // the centre of cell (20, 20)

Goal At(Point2 position, GoalKind kind = GoalKind::kOccupancyFrontier) {
  return {kind, {}, position, position, 10};
}

// A memory with a map of free cells, 4 by 4 metres.
struct Memory {
  Memory() : goals(Options()) {}

  static MissionOptions Options() {
    MissionOptions options;
    options.planning.set_aside_s = 60.0;
    options.frontier.min_occupancy_cell_count = 8;
    return options;
  }
  void Remember(const Goal& goal, ProgressOutcome outcome, std::int64_t time_ns = 0) {
    goals.Remember(goal, outcome, {time_ns, map, variance_ppm2});
  }
  std::vector<SetAsideGoal> SetAside(std::int64_t time_ns = 0) const {
    return goals.SetAside({time_ns, map, variance_ppm2});
  }
  // The first `count` cells of a row through the goal's cell, from it to the east.
  void SetRow(int count, CellState state) {
    for (int x = 0; x < count; ++x) map[Cell{20 + x, 20}] = state;
  }

  GoalMemory goals;
  Grid<CellState> map{GridGeometry{-1.0, -1.0, 0.1, 40, 40}, CellState::kFree};
  Grid<float> variance_ppm2{map.geometry(), 1.0F};
};

TEST(GoalMemory, SetsABlockedGoalAsideUntilItExpires) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  ASSERT_EQ(memory.SetAside(59 * kSecond_ns).size(), 1u);
  EXPECT_EQ(memory.SetAside()[0].reason, "reported blocked");
  EXPECT_TRUE(memory.SetAside(60 * kSecond_ns).empty());
}

TEST(GoalMemory, SetsAGoalAsideThatWasReachedTwice) {
  Memory memory;
  memory.Remember(At({1.0, 1.0}), ProgressOutcome::kReached);
  EXPECT_TRUE(memory.SetAside().empty());
  memory.Remember(At({1.1, 1.0}), ProgressOutcome::kReached);
  ASSERT_EQ(memory.SetAside().size(), 1u);
  EXPECT_EQ(memory.SetAside()[0].reason, "visited without change");
}

TEST(GoalMemory, CountsVisitsFromAnewIfTheMapThereHasChanged) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kReached);
  memory.SetRow(8, CellState::kOccupied);
  memory.Remember(At(kPlace), ProgressOutcome::kReached);
  EXPECT_TRUE(memory.SetAside().empty()) << "the first visit was not in vain";
  memory.Remember(At(kPlace), ProgressOutcome::kReached);
  EXPECT_EQ(memory.SetAside().size(), 1u);
}

TEST(GoalMemory, CountsVisitsFromAnewAfterALongTime) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kReached, 0);
  memory.Remember(At(kPlace), ProgressOutcome::kReached, 61 * kSecond_ns);
  EXPECT_TRUE(memory.SetAside(61 * kSecond_ns).empty());
  memory.Remember(At(kPlace), ProgressOutcome::kReached, 100 * kSecond_ns);
  EXPECT_EQ(memory.SetAside(100 * kSecond_ns).size(), 1u);
}

TEST(GoalMemory, DoesNotMixPlacesOrKindsOrExpectChangeAtRandomPlaces) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kReached);
  memory.Remember(At({1.55, 1.05}), ProgressOutcome::kReached);
  memory.Remember(At(kPlace, GoalKind::kGasFrontier), ProgressOutcome::kReached);
  for (int visit = 0; visit < 3; ++visit) {
    memory.Remember(At(kPlace, GoalKind::kRandomFreeSpace), ProgressOutcome::kReached);
  }
  EXPECT_TRUE(memory.SetAside().empty());
}

// Two visits for readings that leave `kept` of the variance at the place.
bool IsSetAsideAfterReadings(GoalKind kind, float kept) {
  Memory memory;
  memory.Remember(At(kPlace, kind), ProgressOutcome::kReached);
  memory.variance_ppm2[Cell{20, 20}] = kept;
  memory.Remember(At(kPlace, kind), ProgressOutcome::kReached);
  return !memory.SetAside().empty();
}

TEST(GoalMemory, CountsVisitsForReadingsFromAnewIfTheseLoweredTheVariance) {
  EXPECT_FALSE(IsSetAsideAfterReadings(GoalKind::kInformation, 0.85F));
  EXPECT_TRUE(IsSetAsideAfterReadings(GoalKind::kInformation, 0.95F));
  EXPECT_TRUE(IsSetAsideAfterReadings(GoalKind::kInformation, 1.5F)) << "readings that aged";
  EXPECT_FALSE(IsSetAsideAfterReadings(GoalKind::kSite, 0.85F));
  EXPECT_TRUE(IsSetAsideAfterReadings(GoalKind::kSite, 0.95F));
  EXPECT_TRUE(IsSetAsideAfterReadings(GoalKind::kGasFrontier, 0.85F)) << "it should be gone";
}

TEST(GoalMemory, SetsAPlaceAsideWhoseVarianceIsUnknown) {
  EXPECT_TRUE(IsSetAsideAfterReadings(GoalKind::kInformation, NAN));
  Memory memory;
  memory.variance_ppm2 = Grid<float>();
  memory.Remember(At(kPlace, GoalKind::kInformation), ProgressOutcome::kReached);
  memory.Remember(At(kPlace, GoalKind::kInformation), ProgressOutcome::kReached);
  EXPECT_EQ(memory.SetAside().size(), 1u);
}

TEST(GoalMemory, HearsNothingAboutAGoalFromAnAbortedPlan) {
  Memory memory;
  for (int i = 0; i < 3; ++i) memory.Remember(At(kPlace), ProgressOutcome::kAborted);
  EXPECT_TRUE(memory.SetAside().empty());
}

TEST(GoalMemory, OffersAGoalAgainOnceEnoughCellsNearItChanged) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  memory.SetRow(7, CellState::kOccupied);
  EXPECT_EQ(memory.SetAside().size(), 1u);
  memory.SetRow(8, CellState::kOccupied);
  EXPECT_TRUE(memory.SetAside().empty());
}

TEST(GoalMemory, ChangesFartherThanAMetreDoNotMatter) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const int dx = x - 20;
      const int dy = y - 20;
      if (dx * dx + dy * dy > 100) memory.map[Cell{x, y}] = CellState::kOccupied;
    }
  }
  EXPECT_EQ(memory.SetAside().size(), 1u);
}

TEST(GoalMemory, FlickeringCellsNeverAddUpToAChange) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  for (int scan = 0; scan < 100; ++scan) {
    memory.SetRow(7, scan % 2 == 0 ? CellState::kOccupied : CellState::kFree);
    EXPECT_EQ(memory.SetAside(scan * kSecond_ns / 10).size(), 1u);
  }
}

TEST(GoalMemory, ForgetsForGoodWhatAReportFindsChanged) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  memory.SetRow(8, CellState::kOccupied);
  memory.Remember(At({3.0, 3.0}), ProgressOutcome::kAborted);
  memory.SetRow(8, CellState::kFree);
  EXPECT_TRUE(memory.SetAside().empty());
}

TEST(GoalMemory, MayBeSetAsideAnewOnTheChangedMap) {
  Memory memory;
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  memory.SetRow(8, CellState::kOccupied);
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  EXPECT_EQ(memory.SetAside().size(), 1u);
}

TEST(GoalMemory, KeepsItsPlaceWhenTheMapGrows) {
  Memory memory;
  memory.SetRow(3, CellState::kOccupied);
  memory.Remember(At(kPlace), ProgressOutcome::kBlocked);
  Grid<CellState> grown(GridGeometry{-7.4, -7.4, 0.1, 168, 168}, CellState::kUnknown);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) grown[Cell{x + 64, y + 64}] = memory.map[Cell{x, y}];
  }
  EXPECT_EQ(memory.goals.SetAside({0, grown, memory.variance_ppm2}).size(), 1u);
}

TEST(GoalMemory, RemembersAtTheEdgeOfTheMap) {
  Memory memory;
  memory.Remember(At({-0.95, -0.95}), ProgressOutcome::kBlocked);
  memory.Remember(At({50.0, 50.0}), ProgressOutcome::kBlocked);
  EXPECT_EQ(memory.SetAside().size(), 2u);
}

TEST(GoalMemory, IsBounded) {
  Memory memory;
  for (int i = 0; i < 1000; ++i) {
    memory.Remember(At({0.5 * i, 0.0}), ProgressOutcome::kBlocked);
  }
  EXPECT_EQ(memory.SetAside().size(), 200u);
  EXPECT_EQ(memory.SetAside().back().goal.position.x_m, 0.5 * 999) << "the latest are kept";
}

}  // namespace goal_memory_test
}  // namespace plumescout
