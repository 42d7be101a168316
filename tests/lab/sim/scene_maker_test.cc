// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "lab/formats/scene_folder.h"
#include "lab/sim/layout_raster.h"
#include "tests/lab/sim/small_layout.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace scene_maker_test {

SceneMakerOptions ShortRun() {
  SceneMakerOptions options;
  options.wind.flow_s = 4.0;
  options.warm_up_s = 5.0;
  options.frames = 20;
  return options;
}

Scene MakeOrDie(const Layout& layout, const SceneMakerOptions& options) {
  auto scene = MakeScene(layout, options);
  EXPECT_TRUE(scene.ok()) << scene.status();
  return *std::move(scene);
}

TEST(SceneMakerTest, MakesAValidScene) {
  const Layout layout = SmallLayout();
  const Scene scene = MakeOrDie(layout, ShortRun());
  EXPECT_TRUE(ValidateScene(scene).ok()) << ValidateScene(scene);
  EXPECT_EQ(scene.name, "small");
  EXPECT_EQ(scene.sources, layout.sources);
  EXPECT_EQ(scene.start_pose, layout.start_pose);
  EXPECT_EQ(scene.occupancy, Rasterize(layout)->occupancy);
  EXPECT_EQ(scene.series.frames, 20);
  EXPECT_EQ(scene.series.dt_s, 0.5);
  EXPECT_EQ(scene.series.counts.size(), 20u * 40u * 30u);
}

TEST(SceneMakerTest, MeansAreThoseOfTheFrames) {
  const Scene scene = MakeOrDie(SmallLayout(), ShortRun());
  const std::size_t cells = scene.geometry().size();
  const double half_count_ppm = scene.series.scale_ppm_per_count / 2.0;
  for (std::size_t i = 0; i < cells; ++i) {
    double sum = 0.0;
    double squares = 0.0;
    for (int t = 0; t < scene.series.frames; ++t) {
      const double ppm = scene.series.counts[static_cast<std::size_t>(t) * cells + i] *
                         scene.series.scale_ppm_per_count;
      sum += ppm;
      squares += ppm * ppm;
    }
    const double mean = sum / scene.series.frames;
    const double deviation = std::sqrt(std::max(0.0, squares / scene.series.frames - mean * mean));
    // Each frame is off by half a count at most, so are their mean and their deviation (by the
    // triangle inequality for the root mean square); means are stored as float.
    const double rounding_ppm = half_count_ppm + 1e-5 * mean;
    EXPECT_NEAR(scene.conc_mean_ppm[i], mean, rounding_ppm);
    EXPECT_NEAR(scene.conc_std_ppm[i], deviation, 2.0 * rounding_ppm);
  }
}

TEST(SceneMakerTest, MeansBySourceAddUp) {
  Layout layout = SmallLayout();
  layout.sources.push_back({1, 3.0, 2.4, 0.4, 400.0});
  const Scene scene = MakeOrDie(layout, ShortRun());
  for (std::size_t i = 0; i < scene.geometry().size(); ++i) {
    EXPECT_NEAR(scene.conc_mean_ppm[i],
                scene.conc_mean_by_source_ppm[0][i] + scene.conc_mean_by_source_ppm[1][i],
                1e-5 * scene.conc_mean_ppm[i]);
  }
}

TEST(SceneMakerTest, LeavesNoGasUpwindAndMuchAtTheSource) {
  const Scene scene = MakeOrDie(SmallLayout(), ShortRun());
  const auto mean = [&](Point2 point) {
    return scene.conc_mean_ppm[scene.geometry().CellAt(point)];
  };
  EXPECT_GT(mean({1.05, 1.55}), 50.0F);
  EXPECT_LT(mean({0.25, 1.55}), 1.0F);  // 0.8 m up a wind of 1 m/s: 8 sigma of a fresh filament
}

TEST(SceneMakerTest, FramesShowTheSchedule) {
  Layout layout = SmallLayout();
  layout.sources[0].release = {2.0, 5.0, {}, {}};
  const Scene scene = MakeOrDie(layout, ShortRun());
  const auto at_source = [&](double time_s) {
    return SampleConcentration_ppm(scene, {1.05, 1.55}, time_s);
  };
  for (const double before_s : {0.0, 1.0, 2.0}) EXPECT_EQ(at_source(before_s), 0.0);
  for (const double while_s : {2.5, 4.0, 5.0}) EXPECT_GT(at_source(while_s), 50.0);
  // The wind of 1 m/s has carried it off: half a metre are 5 sigma of a fresh filament.
  for (const double after_s : {6.0, 8.0, 9.5}) EXPECT_LT(at_source(after_s), 1.0);
}

TEST(SceneMakerTest, SchedulesReachBackIntoTheWarmUp) {
  Layout layout = SmallLayout();
  layout.sources[0].release.end_s = 0.0;
  const Scene scene = MakeOrDie(layout, ShortRun());
  EXPECT_GT(SampleConcentration_ppm(scene, {1.05, 1.55}, 0.0), 50.0);
  EXPECT_LT(SampleConcentration_ppm(scene, {1.05, 1.55}, 3.0), 1.0);
}

TEST(SceneMakerTest, IsTheSameEveryTimeButForTheSeed) {
  SceneMakerOptions options = ShortRun();
  const Scene once = MakeOrDie(SmallLayout(), options);
  EXPECT_EQ(once.series, MakeOrDie(SmallLayout(), options).series);
  options.seed = 2;
  EXPECT_NE(once.series, MakeOrDie(SmallLayout(), options).series);
}

TEST(SceneMakerTest, SurvivesItsFolder) {
  const Scene scene = MakeOrDie(SmallLayout(), ShortRun());
  const TempFolder folder;
  ASSERT_TRUE(WriteScene(scene, folder.File("small")).ok());
  const auto read = ReadScene(folder.File("small"));
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(read->occupancy, scene.occupancy);
  EXPECT_EQ(read->conc_mean_ppm, scene.conc_mean_ppm);
  EXPECT_EQ(read->series, scene.series);
  EXPECT_EQ(read->wind, scene.wind);
}

TEST(SceneMakerTest, TellsHowFarItIs) {
  std::vector<double> told;
  std::string stages;
  const auto scene = MakeScene(SmallLayout(), ShortRun(), [&](absl::string_view stage, double f) {
    if (told.empty() || !absl::EndsWith(stages, stage)) absl::StrAppend(&stages, " ", stage);
    told.push_back(f);
  });
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(stages, " wind gas");
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1.0);
}

TEST(SceneMakerTest, RejectsOptionsOutOfRange) {
  const auto code = [](const SceneMakerOptions& options) {
    return MakeScene(SmallLayout(), options).status().code();
  };
  SceneMakerOptions options = ShortRun();
  options.frames = 0;
  EXPECT_EQ(code(options), absl::StatusCode::kInvalidArgument);
  options = ShortRun();
  options.frame_period_s = 0.49;  // not on the plume's steps
  EXPECT_EQ(code(options), absl::StatusCode::kInvalidArgument);
  options = ShortRun();
  options.warm_up_s = std::nan("");
  EXPECT_EQ(code(options), absl::StatusCode::kInvalidArgument);
  options = ShortRun();
  options.wind.flow_s = -1.0;
  EXPECT_EQ(code(options), absl::StatusCode::kInvalidArgument);
}

TEST(SceneMakerTest, RejectsLayoutsThatDoNotFitTogether) {
  Layout layout = SmallLayout();
  layout.sources[0] = {0, 2.0, 1.5, 0.4, 1000.0};  // in the box
  EXPECT_EQ(MakeScene(layout, ShortRun()).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace scene_maker_test
}  // namespace plumescout::lab
