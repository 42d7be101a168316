// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/gas_query.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "core/frontier/gas_frontier.h"
#include "tests/support/measured_hall.h"

namespace plumescout {
namespace gas_query_test {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// Four cells in a row from the origin: measured, free, unknown, wall.
Belief Row() {
  const GridGeometry geometry{0.0, 0.0, 0.1, 4, 1};
  Belief belief;
  belief.options = std::make_shared<const MissionOptions>();
  Grid<CellState> states(geometry, CellState::kFree);
  states[Cell{2, 0}] = CellState::kUnknown;
  states[Cell{3, 0}] = CellState::kOccupied;
  Grid<float> mean(geometry, kNaN);
  Grid<float> variance(geometry, kNaN);
  mean[Cell{0, 0}] = 25.0F;
  mean[Cell{1, 0}] = 3.0F;
  const double observed_ppm2 = ObservedVariance_ppm2(belief.options->frontier, belief.options->gas);
  variance[Cell{0, 0}] = static_cast<float>(0.5 * observed_ppm2);
  variance[Cell{1, 0}] = static_cast<float>(2.0 * observed_ppm2);
  belief.occupancy = std::make_shared<const Grid<CellState>>(states);
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(mean);
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(variance);
  return belief;
}

TEST(QueryGas, TellsMeasuredPlacesFromOthers) {
  const auto answers = QueryGas(Row(), {{0.05, 0.05}, {0.15, 0.05}});
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0].mean_ppm, 25.0);
  EXPECT_TRUE(answers[0].observed);
  EXPECT_EQ(answers[1].mean_ppm, 3.0);
  EXPECT_FALSE(answers[1].observed);
  EXPECT_GT(*answers[1].variance_ppm2, *answers[0].variance_ppm2);
}

TEST(QueryGas, TellsOfTheGasThatIsAskedFor) {
  Belief belief = Row();
  MissionOptions options;
  options.gas_species.resize(2);
  options.gas_species[0].name = "methane";
  options.gas_species[1].name = "ozone";
  options.gas_species[1].prior_precision_per_ppm2 = 1000.0;  // variances are judged by that
  belief.options = std::make_shared<const MissionOptions>(options);
  GasField ozone;
  ozone.mean_ppm = std::make_shared<const Grid<float>>(belief.geometry(), 0.5F);
  ozone.variance_ppm2 = belief.gas_variance_ppm2;
  belief.further_gases = {ozone};
  const auto answers = QueryGas(belief, {{0.05, 0.05}}, 1);
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].mean_ppm, 0.5);
  EXPECT_FALSE(answers[0].observed);
  EXPECT_TRUE(QueryGas(belief, {{0.05, 0.05}})[0].observed);
}

TEST(QueryGas, AVarianceInTheOptionsIsForTheFirstGasAlone) {
  Belief belief = Row();
  MissionOptions options;
  options.gas_species.resize(2);
  options.frontier.observed_variance_ppm2 = 1e9;
  belief.options = std::make_shared<const MissionOptions>(options);
  GasField other;
  other.mean_ppm = belief.gas_mean_ppm;
  other.variance_ppm2 = belief.gas_variance_ppm2;
  belief.further_gases = {other};
  const Point2 measured_less = {0.15, 0.05};
  EXPECT_TRUE(QueryGas(belief, {measured_less}, 0)[0].observed);
  EXPECT_FALSE(QueryGas(belief, {measured_less}, 1)[0].observed);
  EXPECT_TRUE(QueryGas(belief, {{0.05, 0.05}}, 1)[0].observed);
}

TEST(QueryGas, HasNoValuesOffFreeCells) {
  const auto answers = QueryGas(Row(), {{0.25, 0.05}, {0.35, 0.05}});
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0].state, CellState::kUnknown);
  EXPECT_EQ(answers[1].state, CellState::kOccupied);
  for (const GasAtPlace& gas : answers) {
    EXPECT_FALSE(gas.mean_ppm || gas.variance_ppm2 || gas.observed);
  }
}

TEST(QueryGas, SaysWhatIsOffTheMap) {
  for (const Point2 place : {Point2{-0.01, 0.05}, Point2{0.05, 1e300}, Point2{-1e300, 0.0}}) {
    const auto answers = QueryGas(Row(), {place});
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_FALSE(answers[0].state || answers[0].mean_ppm || answers[0].observed);
  }
}

TEST(QueryGas, TellsTheNearestReadingWhereverItIsAsked) {
  Belief belief = Row();
  for (const GasAtPlace& gas : QueryGas(belief, {{0.05, 0.05}})) {
    EXPECT_EQ(gas.nearest_reading, std::nullopt);
  }
  SampledCells cells(0.1);
  cells.Add(34, {0.05, 0.05});
  belief.sampled_cells = std::make_shared<const SampledCells>(cells);
  const auto answers = QueryGas(belief, {{0.05, 0.05}, {0.35, 0.05}, {5.05, 0.05}});
  ASSERT_EQ(answers.size(), 3u);
  const double distances_m[] = {0.0, 0.3, 5.0};  // in the cell, in a wall, off the map
  for (std::size_t i = 0; i < answers.size(); ++i) {
    ASSERT_TRUE(answers[i].nearest_reading);
    EXPECT_NEAR(answers[i].nearest_reading->distance_m, distances_m[i], 1e-12);
    EXPECT_EQ(answers[i].nearest_reading->time_ns, 34);
  }
}

TEST(QueryGas, TellsHowTheObjectiveStandsIfItIsAsked) {
  support::MeasuredHall hall(support::Objective(ObjectiveKind::kConfirmClean, 0.0));
  hall.Forget({3, 3});
  const std::vector<Point2> places = {hall.Center({3, 3}), hall.Center({7, 7}), {-9.0, -9.0}};
  const auto answers = QueryGas(hall.belief, places, 0, /*with_verdicts=*/true);
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_EQ(answers[0].verdict, ObjectiveVerdict::kNotMeasured);
  EXPECT_EQ(answers[1].verdict, ObjectiveVerdict::kDecided);
  EXPECT_EQ(answers[2].verdict, std::nullopt);  // off the map
  EXPECT_EQ(QueryGas(hall.belief, places)[1].verdict, std::nullopt);
}

TEST(QueryGas, AMissionWithoutAnObjectiveHasNoVerdicts) {
  const support::MeasuredHall hall(ObjectiveOptions{});
  EXPECT_EQ(QueryGas(hall.belief, {hall.Center({7, 7})}, 0, true)[0].verdict, std::nullopt);
}

TEST(QueryGas, OfNothingIsNothing) { EXPECT_TRUE(QueryGas(Row(), {}).empty()); }

TEST(QueryGas, FreeCellsWithoutAPosteriorHaveNoValues) {
  Belief belief = Row();
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(belief.geometry(), kNaN);
  belief.gas_variance_ppm2 = belief.gas_mean_ppm;
  const auto answers = QueryGas(belief, {{0.05, 0.05}});
  EXPECT_EQ(answers.at(0).state, CellState::kFree);
  EXPECT_FALSE(answers[0].mean_ppm || answers[0].variance_ppm2 || answers[0].observed);
}

}  // namespace gas_query_test
}  // namespace plumescout
