// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/lhr_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumescout::lab {
namespace lhr_scene_test {

TEST(LhrSceneTest, NodesAreCentresOfOpenCells) {
  const Scene scene = MakeLhrScene(LhrTable1Sources());
  ASSERT_TRUE(ValidateScene(scene).ok()) << ValidateScene(scene);
  EXPECT_EQ(scene.geometry().width, 51);
  EXPECT_EQ(scene.geometry().height, 51);
  EXPECT_EQ(scene.geometry().Center({50, 7}), LhrPlace(50.0, 7.0));
  const auto& states = scene.occupancy.values();
  EXPECT_EQ(std::count(states.begin(), states.end(), CellState::kFree), 2601);
  EXPECT_EQ(scene.series.frames, 1);
}

TEST(LhrSceneTest, EachSourceHasItsPlumeDownwind) {
  const std::vector<LhrSource> sources = LhrTable1Sources();
  const Scene scene = MakeLhrScene(sources);
  ASSERT_EQ(sources.size(), 5u);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const Grid<float>& layer = scene.conc_mean_by_source_ppm[s];
    const auto most = std::max_element(layer.values().begin(), layer.values().end());
    const auto index = static_cast<std::size_t>(most - layer.values().begin());
    const Point2 peak = layer.geometry().Center(layer.geometry().CellAtIndex(index));
    EXPECT_LE(Distance_m(peak, sources[s].position), 1.5);  // a cell's diagonal, in the wind
    const Cell source = layer.geometry().CellAt(sources[s].position);
    constexpr int kAway = 4;
    EXPECT_GT(layer.At({source.x, source.y - kAway}, 0.0F),
              100.0F * layer.At({source.x, source.y + kAway}, 0.0F));  // exp(3 * 4) in the law
  }
}

TEST(LhrSceneTest, ConcentrationsAreThePlumeTimesRateAndScale) {
  const LhrAir air{.plume = {}, .ppm_per_g_per_m3 = 3.0};
  const Scene scene = MakeLhrScene({{LhrPlace(10.0, 30.0), 2.0}, {LhrPlace(12.0, 40.0), 5.0}}, air);
  const double expected = 3.0 * (2.0 * air.plume.PerRate_s_per_m3(8.0, 1.0) +
                                 5.0 * air.plume.PerRate_s_per_m3(18.0, -1.0));
  EXPECT_NEAR(scene.conc_mean_ppm[(Cell{11, 22})], expected, 1e-6 * expected);
  EXPECT_EQ(scene.sources[1].rate_ppm_per_s, 15.0);
}

// The frame is in counts of 0.05 ppm.
TEST(LhrSceneTest, TheFrameIsTheMean) {
  const Scene scene = MakeLhrScene(LhrTable1Sources());
  for (const Cell cell : {Cell{8, 47}, Cell{24, 38}, Cell{0, 0}}) {
    const Point2 at = scene.geometry().Center(cell);
    EXPECT_NEAR(SampleConcentration_ppm(scene, at, 1234.5), scene.conc_mean_ppm[cell], 0.0251);
  }
}

TEST(LhrSceneTest, ScenariosVaryTheTableWithinItsRegion) {
  const std::vector<LhrSource> table = LhrTable1Sources();
  for (int scenario = 0; scenario < 200; ++scenario) {
    const std::vector<LhrSource> sources = LhrScenarioSources(3, scenario);
    ASSERT_EQ(sources.size(), table.size());
    for (std::size_t s = 0; s < table.size(); ++s) {
      const Point2 at = sources[s].position;
      EXPECT_TRUE(at.x_m >= 0.5 && at.x_m <= 50.5 && at.y_m >= 0.5 && at.y_m <= 50.5);
      EXPECT_NE(at, table[s].position);
      EXPECT_LE(Distance_m(at, table[s].position), 40.0);  // 5.6 standard deviations
      EXPECT_NEAR(sources[s].rate_g_per_s / table[s].rate_g_per_s, 1.0, 0.2);
    }
  }
}

TEST(LhrSceneTest, AScenarioIsTheSameForEveryoneAndUnlikeTheNext) {
  const auto place = [](std::uint64_t seed, int scenario) {
    return LhrScenarioSources(seed, scenario)[2].position;
  };
  EXPECT_EQ(place(3, 4), place(3, 4));
  EXPECT_NE(place(3, 4), place(3, 3));
  EXPECT_NE(place(3, 4), place(4, 4));
}

TEST(LhrSceneTest, StartsAreTheCorners) {
  const Scene scene = MakeLhrScene(LhrTable1Sources());
  const auto starts = LhrStarts();
  EXPECT_EQ(scene.geometry().CellAt(starts[0]), (Cell{0, 0}));
  EXPECT_EQ(scene.geometry().CellAt(starts[1]), (Cell{50, 0}));
  EXPECT_EQ(scene.geometry().CellAt(starts[2]), (Cell{0, 50}));
  EXPECT_EQ(scene.geometry().CellAt(starts[3]), (Cell{50, 50}));
}

TEST(LhrSceneTest, WithoutSourcesTheAirIsClean) {
  const Scene scene = MakeLhrScene({});
  EXPECT_TRUE(ValidateScene(scene).ok());
  EXPECT_EQ(scene.conc_mean_ppm[(Cell{25, 25})], 0.0F);
}

}  // namespace lhr_scene_test
}  // namespace plumescout::lab
