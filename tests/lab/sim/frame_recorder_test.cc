// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/frame_recorder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace frame_recorder_test {

constexpr GridGeometry kGeometry{0.0, 0.0, 0.1, 2, 1};

Grid<float> Layer(float west, float east) {
  Grid<float> layer(kGeometry);
  layer[Cell{0, 0}] = west;
  layer[Cell{1, 0}] = east;
  return layer;
}

TEST(FrameRecorderTest, KeepsFramesAndMeansOfAllSources) {
  FrameRecorder recorder(kGeometry, 2, 2, 0.25);
  recorder.Add({Layer(1.0F, 0.0F), Layer(2.0F, 0.5F)});
  recorder.Add({Layer(3.0F, 0.0F), Layer(4.0F, 1.5F)});
  Scene scene;
  recorder.MoveTo(scene);
  EXPECT_EQ(scene.series.frames, 2);
  EXPECT_EQ(scene.series.dt_s, 0.25);
  const double scale = scene.series.scale_ppm_per_count;
  ASSERT_EQ(scene.series.counts.size(), 4u);
  EXPECT_NEAR(scene.series.counts[0] * scale, 3.0, scale / 2.0);
  EXPECT_NEAR(scene.series.counts[3] * scale, 1.5, scale / 2.0);
  EXPECT_EQ(scene.conc_mean_by_source_ppm[0], Layer(2.0F, 0.0F));
  EXPECT_EQ(scene.conc_mean_by_source_ppm[1], Layer(3.0F, 1.0F));
  EXPECT_EQ(scene.conc_mean_ppm, Layer(5.0F, 1.0F));
  EXPECT_EQ(scene.conc_std_ppm, Layer(2.0F, 0.5F));
}

TEST(FrameRecorderTest, CountsEndWhereTheirRangeEnds) {
  FrameRecorder recorder(kGeometry, 1, 1, 0.5);
  recorder.Add({Layer(1e6F, 0.0F)});
  Scene scene;
  recorder.MoveTo(scene);
  EXPECT_EQ(scene.series.counts[0], 65535);
  EXPECT_EQ(scene.conc_mean_ppm[Cell(0, 0)], 1e6F);  // the mean is not cut
}

}  // namespace frame_recorder_test
}  // namespace plumescout::lab
