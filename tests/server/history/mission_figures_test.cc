// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>

#include "core/types/objective.h"

namespace plumescout::server {
namespace mission_figures_test {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// Three cells of half a metre in a row: free with gas, wall, unknown.
Belief ThreeCells() {
  const GridGeometry geometry{.resolution_m = 0.5, .width = 3, .height = 1};
  Belief belief;
  belief.revision = 7;
  belief.sample_time_ns = 5'000'000'000;
  belief.options = std::make_shared<MissionOptions>();
  const auto grid = [&](auto first, auto second, auto third) {
    Grid<decltype(first)> cells(geometry);
    cells.values() = {first, second, third};
    return std::make_shared<const Grid<decltype(first)>>(cells);
  };
  belief.occupancy = grid(CellState::kFree, CellState::kOccupied, CellState::kUnknown);
  belief.traversable = grid(std::uint8_t{1}, std::uint8_t{0}, std::uint8_t{0});
  belief.gas_mean_ppm = grid(40.0F, kNone, kNone);
  belief.gas_variance_ppm2 = grid(9.0F, kNone, kNone);
  belief.sampled = grid(std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0});
  belief.gas_counters.in_posterior = 4;
  return belief;
}

TEST(FiguresOf, AMapIsToldInFigures) {
  const v1::MissionFigures figures = FiguresOf(ThreeCells(), "hall", 2'000'000'000);
  EXPECT_EQ(figures.revision(), 7);
  EXPECT_DOUBLE_EQ(figures.elapsed_s(), 3.0);
  EXPECT_DOUBLE_EQ(figures.known_area_m2(), 0.5);
  EXPECT_FALSE(figures.has_undecided_area_m2());
  ASSERT_EQ(figures.gases_size(), 1);
  EXPECT_EQ(figures.gases(0).species(), "");
  EXPECT_DOUBLE_EQ(figures.gases(0).max_mean_ppm(), 40.0);
  EXPECT_DOUBLE_EQ(figures.gases(0).plume_area_m2(), 0.25);
  EXPECT_NEAR(figures.gases(0).mean_entropy_nats(),
              0.5 * std::log(2 * std::numbers::pi * std::numbers::e * 9.0), 1e-12);
  EXPECT_EQ(figures.gases(0).in_posterior_count(), 4);
}

TEST(FiguresOf, WhatIsNotThereIsNotTold) {
  Belief belief = ThreeCells();
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(belief.geometry(), kNone);
  belief.gas_variance_ppm2 = belief.gas_mean_ppm;
  const v1::MissionFigures figures = FiguresOf(belief, "hall", 0);
  EXPECT_FALSE(figures.gases(0).has_max_mean_ppm());
  EXPECT_FALSE(figures.gases(0).has_mean_entropy_nats());
  EXPECT_EQ(figures.gases(0).plume_area_m2(), 0.0);
}

TEST(FiguresOf, EveryRobotAndEveryGasIsThere) {
  Belief belief = ThreeCells();
  auto options = std::make_shared<MissionOptions>();
  options->gas_species = {{"methane", {}, {}, {}, {}}, {"ammonia", {}, {}, {}, {}}};
  belief.options = options;
  GasField ammonia = belief.Gas(0);
  ammonia.counters.in_posterior = 2;
  belief.further_gases = {ammonia};
  belief.robots["r1"].state.id = "r1";
  belief.robots["r1"].state.applied_sequence = 12;
  belief.objective.emplace().undecided_area_m2 = 0.25;
  const v1::MissionFigures figures = FiguresOf(belief, "hall", 0);
  ASSERT_EQ(figures.gases_size(), 2);
  EXPECT_EQ(figures.gases(1).species(), "ammonia");
  EXPECT_EQ(figures.gases(1).in_posterior_count(), 2);
  EXPECT_EQ(figures.gases(1).plume_area_m2(), 0.0);  // its threshold is nobody's
  ASSERT_EQ(figures.robots_size(), 1);
  EXPECT_EQ(figures.robots(0).robot(), "missions/hall/robots/r1");
  EXPECT_EQ(figures.robots(0).applied_sequence(), 12);
  EXPECT_DOUBLE_EQ(figures.undecided_area_m2(), 0.25);
}

}  // namespace mission_figures_test
}  // namespace plumescout::server
