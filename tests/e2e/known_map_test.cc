// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A robot without a LiDAR in a building that its mission knows.
#include <gtest/gtest.h>

#include <memory>
#include <variant>

#include "core/types/prior_map.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace known_map_test {

EpisodeOptions BlindOptions() {
  EpisodeOptions options = HallOptions();
  options.rates.scan_hz = 0.0;
  StartWith(std::make_shared<const Grid<CellState>>(GasHall().occupancy()), *options.create);
  return options;
}

TEST(KnownMapTest, ARobotThatNeverScansMapsTheGasOverTheWire) {
  const auto server = StartServer();
  const auto client = ClientOf(*server);
  bool scanned = false;
  const auto planner = WithTap(*client, [&](const Observation& observation) {
    scanned = scanned || std::holds_alternative<Scan>(observation.payload);
    return observation;
  });
  const auto run = RunInHall(*planner, BlindOptions());
  ASSERT_TRUE(run.ok()) << run.status();
  EXPECT_FALSE(scanned);
  EXPECT_GT(run->episode.distance_m, 5.0);
  EXPECT_GT(run->map.gas_counters.in_posterior, 50);
  EXPECT_EQ(run->map.gas_counters.waiting, 0);
  for (const IssuedPlan& issued : run->episode.plans) {
    EXPECT_TRUE(issued.plan.chosen < 0 || issued.plan.phase != MissionPhase::kExploring);
  }
  const MetricSample& last = run->episode.samples.back();
  EXPECT_EQ(last.metrics.completeness, 1.0) << "nothing else was to be found";
  EXPECT_LT(last.metrics.rmse_ppm, last.metrics.rmse_zero_ppm);
}

TEST(KnownMapTest, RunsRepeatToTheByte) {
  const auto server = StartServer();
  const auto client = ClientOf(*server);
  const auto first = RunInHall(*client, BlindOptions());
  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_TRUE(client->DeleteMission(kHallMission).ok());
  const auto second = RunInHall(*client, BlindOptions());
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_TRUE(ComparablePlans(first->episode) == ComparablePlans(second->episode));
  EXPECT_TRUE(SameMap(first->map, second->map));
}

}  // namespace known_map_test
}  // namespace plumescout::lab
