// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/goal_offer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "tests/support/goal_case.h"

namespace plumescout {
namespace goal_offer_test {

using testing::GoalCase;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const testing::GridArt kOpenEnded = {"##########",  //
                                     "#gggggggg?",  //
                                     "#Sggggggg?",  //
                                     "##########"};
const testing::GridArt kClosed = {"##########",  //
                                  "#gggggggg#",  //
                                  "#Sggggggg#",  //
                                  "##########"};

// The map with clean air measured in every cell drawn 'g', so that no gas is unobserved.
GoalCase Measured(const testing::GridArt& art) {
  GoalCase c(art);
  c.AddGas(art, 0.0F);
  return c;
}

GoalOffer Find(const GoalCase& c) {
  Rng rng(1);
  return FindGoals(c.Query(), rng);
}

// As if the only frontier were taken by another robot, or set aside.
Goal TheFrontier(const GoalCase& c) { return Find(c).goals.at(0); }

TEST(FindGoals, OffersFrontiersWhileThereAreAny) {
  GoalCase c = Measured(kOpenEnded);
  c.belief.robots["r"].fruitless_fallbacks = 99;
  const GoalOffer found = Find(c);
  ASSERT_THAT(found.goals, SizeIs(1));
  EXPECT_EQ(found.goals[0].kind, GoalKind::kOccupancyFrontier);
  EXPECT_FALSE(found.fallback);
  EXPECT_FALSE(found.complete);
}

TEST(FindGoals, ToldToStopDoesNotFallBack) {
  GoalCase c = Measured(kClosed);
  GoalQuery query = c.Query();
  query.stop = [] { return true; };
  Rng rng(1);
  const GoalOffer found = FindGoals(query, rng);
  EXPECT_FALSE(found.fallback);
  EXPECT_FALSE(found.complete);
  EXPECT_THAT(found.goals, IsEmpty());
}

TEST(FindGoals, FallsBackToRandomPlacesIfNoFrontierIsLeft) {
  GoalCase c = Measured(kClosed);
  c.belief.robots["r"].fruitless_fallbacks = 1;
  const GoalOffer found = Find(c);
  EXPECT_TRUE(found.fallback);
  EXPECT_THAT(found.goals, SizeIs(5));
}

TEST(FindGoals, IsCompleteAfterFruitlessFallbacks) {
  GoalCase c = Measured(kClosed);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  const GoalOffer found = Find(c);
  EXPECT_TRUE(found.complete);
  EXPECT_THAT(found.goals, IsEmpty());
  c.options.fallback_limit = 3;
  EXPECT_FALSE(Find(c).complete);
}

TEST(FindGoals, FallsBackFirstToPlacesWithUnobservedGas) {
  const testing::GridArt art = {"##########",  //
                                "#ggg.....#",  //
                                "#Sgg.....#",  //
                                "#ggg.....#",  //
                                "##########"};
  GoalCase c = Measured(art);
  c.belief.gas_counters.readings = 1;
  c.belief.robots["r"].fruitless_fallbacks = 99;
  const GoalOffer found = Find(c);
  EXPECT_TRUE(found.fallback);
  EXPECT_FALSE(found.complete);
  for (const Goal& goal : found.goals) EXPECT_GE(goal.cell.x, 5);
  c.options.fallback_to_unobserved = false;
  EXPECT_TRUE(Find(c).complete);
}

TEST(FindGoals, IsCompleteWithoutAGasSensorThoughAllGasIsUnobserved) {
  GoalCase c(kClosed);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  EXPECT_TRUE(Find(c).complete);
  c.belief.gas_counters.readings = 1;
  EXPECT_FALSE(Find(c).complete);
}

TEST(FindGoals, IsNotCompleteWhileAnotherRobotDrivesToAFrontier) {
  GoalCase c = Measured(kOpenEnded);
  c.belief.claims = {{"other", 1, TheFrontier(c), 1000}};
  c.belief.robots["r"].fruitless_fallbacks = 99;
  const GoalOffer found = Find(c);
  EXPECT_FALSE(found.complete);
  EXPECT_TRUE(found.fallback);
  EXPECT_THAT(found.rejected, SizeIs(1));
}

TEST(FindGoals, IsCompleteThoughAFrontierIsSetAside) {
  GoalCase c = Measured(kOpenEnded);
  c.belief.set_aside = {{TheFrontier(c), "visited without change", 1000}};
  EXPECT_TRUE(Find(c).fallback);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  EXPECT_TRUE(Find(c).complete);
}

// A strip of 3 m that is known roughly and open in the east: gas in its near half.
GoalCase Strip(float variance_ppm2) {
  const testing::GridArt art = {std::string(32, '#'), "#" + std::string(30, 'g') + "?",
                                "#S" + std::string(29, 'g') + "?", std::string(32, '#')};
  GoalCase c(art);
  c.options.goal_policy = GoalPolicy::kEverything;
  c.belief.gas_counters.readings = 1;
  Grid<float> mean(c.belief.geometry(), 0.0F);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (mean.geometry().CellAtIndex(i).x < 16) mean[i] = 20.0F;
  }
  c.belief.gas_mean_ppm = std::make_shared<const Grid<float>>(mean);
  c.belief.gas_variance_ppm2 =
      std::make_shared<const Grid<float>>(c.belief.geometry(), variance_ppm2);
  return c;
}

bool HasKind(const GoalOffer& found, GoalKind kind) {
  return std::any_of(found.goals.begin(), found.goals.end(),
                     [kind](const Goal& goal) { return goal.kind == kind; });
}

constexpr float kRough_ppm2 = 0.15F;  // observed (0.7 epsilon_inf is 0.22), and half of that is not
constexpr float kFine_ppm2 = 0.01F;

TEST(FindGoals, OfEverythingAreFrontiersAndPlacesWhereReadingsTellMuch) {
  GoalCase c = Strip(kRough_ppm2);
  EXPECT_TRUE(HasKind(Find(c), GoalKind::kOccupancyFrontier));
  EXPECT_TRUE(HasKind(Find(c), GoalKind::kInformation));
  EXPECT_FALSE(Find(c).fallback);
  c.options.goal_policy = GoalPolicy::kGasFirst;
  EXPECT_FALSE(HasKind(Find(c), GoalKind::kInformation));
  c = Strip(kFine_ppm2);
  EXPECT_FALSE(HasKind(Find(c), GoalKind::kInformation));
}

TEST(FindGoals, OfEverythingFallsBackOnlyIfThereIsNothing) {
  GoalCase c = Strip(kRough_ppm2);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  c.belief.set_aside = {{TheFrontier(c), "visited without change", 1000}};
  const GoalOffer rough = Find(c);
  EXPECT_FALSE(rough.fallback || rough.complete);
  EXPECT_FALSE(HasKind(rough, GoalKind::kOccupancyFrontier));
  EXPECT_TRUE(HasKind(rough, GoalKind::kInformation));
  c.belief.gas_variance_ppm2 = Strip(kFine_ppm2).belief.gas_variance_ppm2;
  EXPECT_TRUE(Find(c).complete);
  c.belief.robots["r"].fruitless_fallbacks = 0;
  EXPECT_TRUE(Find(c).fallback);
}

TEST(FindGoals, IsNotCompleteWhileAnotherRobotReadsWhereThereIsMuchToTell) {
  GoalCase c = Strip(kRough_ppm2);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  c.belief.set_aside = {{TheFrontier(c), "visited without change", 1000}};
  std::int64_t plan = 0;
  for (GoalOffer found = Find(c); HasKind(found, GoalKind::kInformation); found = Find(c)) {
    ASSERT_LT(plan, 20);
    for (const Goal& goal : found.goals) c.belief.claims.push_back({"other", ++plan, goal, 1000});
  }
  EXPECT_GT(plan, 0);
  EXPECT_FALSE(Find(c).complete);
  EXPECT_TRUE(Find(c).fallback);
}

// The robot came from the far end.
GoalCase FarFromHome(const testing::GridArt& art) {
  GoalCase c = Measured(art);
  c.belief.robots["r"].first_place = c.belief.geometry().Center({7, 1});
  return c;
}

TEST(FindGoals, OfARobotOrderedHomeIsHomeAlone) {
  const GoalCase c = FarFromHome(kOpenEnded);
  GoalQuery query = c.Query();
  query.go_home = true;
  Rng rng(1);
  const GoalOffer found = FindGoals(query, rng);
  ASSERT_THAT(found.goals, SizeIs(1));
  EXPECT_EQ(found.goals[0].kind, GoalKind::kHome);
  EXPECT_FALSE(found.fallback);
}

TEST(GoHome, OfARobotThatIsHomeIsNothing) {
  const GoalCase c = Measured(kOpenEnded);
  EXPECT_THAT(GoHome(c.Query()).goals, IsEmpty());
  EXPECT_THAT(GoHome(c.Query()).rejected, IsEmpty());
}

TEST(GoHome, WithoutAWayIsARejection) {
  GoalCase c = Measured(kOpenEnded);
  c.belief.robots["r"].first_place = Point2{-9.0, 0.0};
  const GoalOffer found = GoHome(c.Query());
  EXPECT_THAT(found.goals, IsEmpty());
  ASSERT_THAT(found.rejected, SizeIs(1));
  EXPECT_EQ(found.rejected[0].goal.kind, GoalKind::kHome);
  EXPECT_EQ(found.rejected[0].reason, RejectionReason::kUnreachable);
}

TEST(FindGoals, GoesHomeBeforeItIsCompleteIfToldSo) {
  GoalCase c = FarFromHome(kClosed);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  EXPECT_TRUE(Find(c).complete);
  c.options.return_home = true;
  const GoalOffer found = Find(c);
  EXPECT_FALSE(found.complete);
  EXPECT_FALSE(found.fallback);
  ASSERT_THAT(found.goals, SizeIs(1));
  EXPECT_EQ(found.goals[0].kind, GoalKind::kHome);
}

TEST(FindGoals, IsCompleteAtHomeOrWithoutAWayThere) {
  GoalCase c = Measured(kClosed);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  c.options.return_home = true;
  EXPECT_TRUE(Find(c).complete) << "at home";
  c.belief.robots["r"].first_place = Point2{-9.0, 0.0};
  EXPECT_TRUE(Find(c).complete);
  EXPECT_THAT(Find(c).rejected, SizeIs(1));
}

// With an edge of the unseen at either end, and another robot near the east one.
GoalCase TwoRobots() {
  GoalCase c = Measured({"############",  //
                         "?gggggggggg?",  //
                         "?gSgggggggg?",  //
                         "############"});
  c.options.balanced_areas = true;
  RobotRecord& other = c.belief.robots["a"];
  other.state.id = "a";
  other.state.has_pose = true;
  const Point2 place = c.belief.geometry().Center({9, 1});
  other.state.pose = {place.x_m, place.y_m, 0.0};
  return c;
}

TEST(FindGoals, LeavesToOthersWhatLiesInTheirAreas) {
  GoalCase c = TwoRobots();
  const GoalOffer found = Find(c);
  ASSERT_THAT(found.goals, SizeIs(1));
  EXPECT_LT(found.goals[0].cell.x, 4);
  ASSERT_THAT(found.rejected, SizeIs(1));
  EXPECT_GT(found.rejected[0].goal.cell.x, 7);
  EXPECT_EQ(found.rejected[0].reason, RejectionReason::kClaimed);
  EXPECT_EQ(found.rejected[0].detail, "in the area of robot \"a\"");
  c.options.balanced_areas = false;
  EXPECT_THAT(Find(c).goals, SizeIs(2));
}

TEST(FindGoals, HelpsInOthersAreasOnceItsOwnHasNothing) {
  GoalCase c = TwoRobots();
  const Goal own = Find(c).goals.at(0);
  c.belief.set_aside.push_back({own, "reported blocked", 1'000'000'000});
  const GoalOffer found = Find(c);
  ASSERT_THAT(found.goals, SizeIs(1));
  EXPECT_GT(found.goals[0].cell.x, 7);
  EXPECT_FALSE(found.fallback);
}

}  // namespace goal_offer_test
}  // namespace plumescout
