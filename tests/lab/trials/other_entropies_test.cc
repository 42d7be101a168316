// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/other_entropies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace other_entropies_test {

using ::plumescout::testing::GridArt;
using ::plumescout::testing::GridFromArt;

Scene SceneOf(const GridArt& art) {
  Scene scene;
  scene.occupancy = GridFromArt(art);
  scene.conc_mean_ppm = Grid<float>(scene.geometry(), 5.0F);  // all free cells are critical
  return scene;
}

Observation ReadingIn(const Scene& scene, Cell cell) {
  const Point2 at = scene.geometry().Center(cell);
  Observation observation;
  observation.pose = {at.x_m, at.y_m, 0.0};
  observation.payload = GasReading{3.0, 0.0};
  return observation;
}

double Entropy_nats(double variance_ppm2) {
  return 0.5 * std::log(2.0 * M_PI * M_E * variance_ppm2);
}

TEST(OtherEntropies, OfOneCellAreThoseOfItsReadings) {
  const Scene scene = SceneOf({"#.#"});
  const GasOptions gas;
  const Observation reading = ReadingIn(scene, {1, 0});
  const auto found = FindOtherEntropies(scene, gas, {reading, reading}, scene.occupancy);
  ASSERT_TRUE(found.ok()) << found.status();
  const double precision =
      gas.background_precision_per_ppm2 + 2.0 * gas.observation_precision_per_ppm2;
  EXPECT_NEAR(found->whole_building_nats, Entropy_nats(1.0 / precision), 1e-9);
  EXPECT_NEAR(found->propagated_nats, Entropy_nats(1.0 / precision), 1e-9);
}

// Belief propagation is exact where there are no loops.
TEST(OtherEntropies, AgreeInACorridorOneCellWide) {
  const Scene scene = SceneOf({"......"});
  const auto found = FindOtherEntropies(scene, {}, {ReadingIn(scene, {2, 0})}, scene.occupancy);
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found->propagated_nats, found->whole_building_nats, 0.01);
}

TEST(OtherEntropies, PropagationIsTooSureWhereThereAreLoops) {
  const Scene scene = SceneOf({"......", "......", "......", "......"});
  const auto found = FindOtherEntropies(scene, {}, {ReadingIn(scene, {2, 1})}, scene.occupancy);
  ASSERT_TRUE(found.ok());
  EXPECT_LT(found->propagated_nats, found->whole_building_nats - 0.1);
}

TEST(OtherEntropies, TheWholeBuildingCountsWhateverWasSeenOfIt) {
  const Scene scene = SceneOf({"......", "......"});
  const std::vector<Observation> readings = {ReadingIn(scene, {0, 0})};
  const auto all = FindOtherEntropies(scene, {}, readings, scene.occupancy);
  const auto none = FindOtherEntropies(scene, {}, readings, GridFromArt({"??????", "??????"}));
  ASSERT_TRUE(all.ok() && none.ok());
  EXPECT_DOUBLE_EQ(none->whole_building_nats, all->whole_building_nats);
  EXPECT_NEAR(none->propagated_nats, 12.0 * Entropy_nats(OpenLatticeVariance_ppm2({})), 1e-9);
}

}  // namespace other_entropies_test
}  // namespace plumescout::lab
