// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/support/small_scene.h"

namespace plumescout::lab {
namespace scene_test {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Checks that the scene is refused with a message that holds `name`.
void ExpectInvalid(const Scene& scene, const std::string& name) {
  const absl::Status status = ValidateScene(scene);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr(name));
}

TEST(Scene, AWholeSceneIsValidWithAndWithoutWind) {
  Scene scene = MakeSmallScene();
  EXPECT_EQ(ValidateScene(scene), absl::OkStatus());
  scene.wind.reset();
  EXPECT_EQ(ValidateScene(scene), absl::OkStatus());
}

TEST(Scene, AnEmptySceneIsInvalid) { ExpectInvalid(Scene(), "geometry"); }

TEST(Scene, UnknownCellsAreInvalid) {
  Scene scene = MakeSmallScene();
  scene.occupancy[Cell{0, 0}] = CellState::kUnknown;
  ExpectInvalid(scene, "occupancy");
}

TEST(Scene, RastersOfAnotherGeometryAreInvalid) {
  const Grid<float> other(GridGeometry{0, 0, 0.1, 5, 4});
  Scene scene = MakeSmallScene();
  scene.conc_mean_ppm = other;
  ExpectInvalid(scene, "conc_mean_ppm");
  scene = MakeSmallScene();
  scene.wind->v_mps = other;
  ExpectInvalid(scene, "wind.v_mps");
  scene = MakeSmallScene();
  scene.conc_mean_by_source_ppm.pop_back();
  ExpectInvalid(scene, "one layer per source");
}

TEST(Scene, ValuesThatAreNotFiniteOrNegativeAreInvalid) {
  Scene scene = MakeSmallScene();
  scene.conc_std_ppm[std::size_t{3}] = kNan;
  ExpectInvalid(scene, "conc_std_ppm = nan in cell (3, 0)");
  scene = MakeSmallScene();
  scene.conc_mean_by_source_ppm[1][std::size_t{3}] = -1.0F;
  ExpectInvalid(scene, "conc_mean_by_source_ppm = -1 in cell (3, 0)");
  scene = MakeSmallScene();
  scene.wind->u_mps[std::size_t{3}] = std::numeric_limits<float>::infinity();
  ExpectInvalid(scene, "wind.u_mps");
  scene = MakeSmallScene();
  scene.sources[1].rate_ppm_per_s = -1.0;
  ExpectInvalid(scene, "source 7");
  scene = MakeSmallScene();
  scene.sources[1].release.start_s = kNan;
  ExpectInvalid(scene, "source 7: release.start_s = nan");
  scene = MakeSmallScene();
  scene.critical_threshold_ppm = kNan;
  ExpectInvalid(scene, "critical_threshold_ppm");
}

TEST(Scene, ASeriesThatDoesNotFillItsFramesIsInvalid) {
  Scene scene = MakeSmallScene();
  scene.series.counts.pop_back();
  ExpectInvalid(scene, "series.counts holds");
  scene = MakeSmallScene();
  scene.series.frames = 0;
  ExpectInvalid(scene, "series.counts holds");
  scene = MakeSmallScene();
  scene.series.dt_s = 0.0;
  ExpectInvalid(scene, "dt_s");
  scene = MakeSmallScene();
  scene.series.scale_ppm_per_count = kNan;
  ExpectInvalid(scene, "scale_ppm_per_count");
}

TEST(Scene, TheStartMustStandOnAFreeCell) {
  Scene scene = MakeSmallScene();
  scene.start_pose.x_m = -0.2;  // in the wall
  ExpectInvalid(scene, "start_pose");
  scene.start_pose.x_m = 100.0;
  ExpectInvalid(scene, "start_pose");
  scene.start_pose.x_m = kNan;
  ExpectInvalid(scene, "start_pose");
}

TEST(Scene, OpeningsMustLieApartInTheOuterWalls) {
  Scene scene = MakeSmallScene();  // covers x from -0.25 to 0.25 m, y from 1 to 1.4 m
  scene.openings[1] = {Side::kNorth, -0.2, 0.6, {}};
  ExpectInvalid(scene, "openings[1] from -0.2 to 0.6 m");
  scene.openings[1] = {Side::kNorth, 0.1, 0.1, {}};
  ExpectInvalid(scene, "openings[1] from 0.1 to 0.1 m");
  scene.openings[1] = {Side::kNorth, kNan, 0.1, {}};
  ExpectInvalid(scene, "openings[1] from nan");
  scene.openings[1] = {Side::kNorth, -0.1, 0.1, -2.0};
  ExpectInvalid(scene, "openings[1].inflow_mps = -2");
  scene.openings[1] = {Side::kWest, 1.15, 1.3, {}};
  ExpectInvalid(scene, "openings[1] overlaps openings[0]");
  scene.openings[1] = {Side::kWest, 1.2, 1.3, {}};  // touches
  EXPECT_EQ(ValidateScene(scene), absl::OkStatus());
}

TEST(Scene, TheNearestCellAndFrameAreSampled) {
  const Scene scene = MakeSmallScene();  // counts are their own index; 0.05 ppm per count
  EXPECT_DOUBLE_EQ(SampleConcentration_ppm(scene, {-0.2, 1.05}, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(SampleConcentration_ppm(scene, {0.0, 1.25}, 0.6), (20 + 2 * 5 + 2) * 0.05);
}

TEST(Scene, PointsAndTimesBeyondTheSceneAreClamped) {
  const Scene scene = MakeSmallScene();
  EXPECT_DOUBLE_EQ(SampleConcentration_ppm(scene, {1e9, 1e9}, 1e9), 59 * 0.05);
  EXPECT_DOUBLE_EQ(SampleConcentration_ppm(scene, {-1e9, -1e9}, -1e9), 0.0);
}

}  // namespace scene_test
}  // namespace plumescout::lab
