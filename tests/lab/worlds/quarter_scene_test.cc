// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/quarter_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace plumescout::lab {
namespace quarter_scene_test {

const QuarterWorld& World() {
  static const QuarterWorld world = MakeQuarterWorld(1).value();
  return world;
}

bool InPlume(const Scene& scene, Point2 at) {
  return scene.conc_mean_ppm[scene.geometry().CellAt(at)] > scene.critical_threshold_ppm;
}

TEST(QuarterSceneTest, IsAValidSceneOfTenThousandSeconds) {
  const Scene& scene = World().scene;
  EXPECT_TRUE(ValidateScene(scene).ok()) << ValidateScene(scene);
  EXPECT_GE((scene.series.frames - 1) * scene.series.dt_s, 10'000.0);
}

TEST(QuarterSceneTest, TheTruthHasTheScaleThatIsAskedFor) {
  const Scene& scene = World().scene;
  double squares = 0.0;
  int cells = 0;
  for (std::size_t i = 0; i < scene.occupancy.size(); ++i) {
    if (scene.occupancy[i] != CellState::kFree) continue;
    squares += std::pow(scene.conc_mean_ppm[i], 2.0);
    ++cells;
  }
  EXPECT_NEAR(std::sqrt(squares / cells), 20.0, 1e-3);  // of sums of floats
}

TEST(QuarterSceneTest, ThePlumeReachesSeveralHundredMetresDownwindAndNoneUpwind) {
  const Scene& scene = World().scene;
  const Point2 source{scene.sources[0].x_m, scene.sources[0].y_m};
  double farthest_m = 0.0;
  double upwind_m = 0.0;
  for (std::size_t i = 0; i < scene.occupancy.size(); ++i) {
    const Point2 at = scene.geometry().Center(scene.geometry().CellAtIndex(i));
    if (!InPlume(scene, at)) continue;
    farthest_m = std::max(farthest_m, Distance_m(at, source));
    upwind_m = std::max(upwind_m, source.x_m - at.x_m);
  }
  EXPECT_GT(farthest_m, 400.0);
  EXPECT_LT(upwind_m, 100.0);
}

// The mean is what the frames say, but for their counts of 0.05 ppm and what these cut off.
TEST(QuarterSceneTest, TheTruthIsTheMeanOverTime) {
  const Scene& scene = World().scene;
  for (const Point2 at : World().starts) {
    double sum = 0.0;
    for (int f = 0; f < scene.series.frames; ++f) {
      sum += SampleConcentration_ppm(scene, at, f * scene.series.dt_s);
    }
    EXPECT_NEAR(sum / scene.series.frames, scene.conc_mean_ppm[scene.geometry().CellAt(at)], 0.026);
  }
}

TEST(QuarterSceneTest, ThePlumeMeanders) {
  const Scene& scene = World().scene;
  int swept = 0;  // cells in the plume whose concentration varies by more than half its mean
  int inside = 0;
  for (std::size_t i = 0; i < scene.occupancy.size(); ++i) {
    if (scene.conc_mean_ppm[i] <= scene.critical_threshold_ppm) continue;
    ++inside;
    swept += scene.conc_std_ppm[i] > 0.5F * scene.conc_mean_ppm[i] ? 1 : 0;
  }
  EXPECT_GT(swept, inside / 4);
}

TEST(QuarterSceneTest, StartsLieInAndOutOfThePlumeAmongHousesAndNot) {
  const Scene& scene = World().scene;
  ASSERT_EQ(World().starts.size(), 10u);
  std::set<std::pair<bool, bool>> kinds;
  std::set<std::pair<double, double>> places;
  for (const Point2 start : World().starts) {
    EXPECT_EQ(scene.occupancy[scene.geometry().CellAt(start)], CellState::kFree);
    kinds.insert({World().built_up.Holds(start), InPlume(scene, start)});
    places.insert({start.x_m, start.y_m});
  }
  EXPECT_EQ(kinds.size(), 4u);
  EXPECT_EQ(places.size(), 10u);
}

TEST(QuarterSceneTest, TheSeedDecides) {
  const QuarterWorld again = MakeQuarterWorld(1).value();
  EXPECT_EQ(again.scene.series, World().scene.series);
  EXPECT_EQ(again.starts, World().starts);
}

}  // namespace quarter_scene_test
}  // namespace plumescout::lab
