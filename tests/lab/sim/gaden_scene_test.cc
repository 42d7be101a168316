// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gaden_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "absl/strings/str_cat.h"
#include "formats/file_io.h"
#include "formats/zlib_codec.h"
#include "lab/sim/gaden_slice.h"
#include "tests/support/gaden_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace gaden_scene_test {

using testing::HasSubstr;

// A project as GADEN 3 keeps it: configuration/{OccupancyGrid3D.csv, wind, simulations/one/result}.
class GadenSceneTest : public testing::Test {
 protected:
  GadenSceneTest() {
    Write("OccupancyGrid3D.csv", support::EnvironmentText(room_));
    Write("wind/wind_iteration_0", support::WindBytes3(room_, 1.0F, 0.0F));
    Write("wind/wind_iteration_1", support::WindBytes3(room_, 0.0F, -2.0F));
    for (int i = 0; i < 4; ++i) WriteFrame("simulations/one/result", i, FrameAt(i));
    import_.results = {Path("simulations/one/result")};
    import_.name = "room";
    import_.height_m = 0.75;
    import_.frame_period_s = 2.0;
    import_.start_pose = {-0.25, 2.75, 1.0};
  }

  // A filament that grows; the last frame has the second wind.
  static GadenFrame FrameAt(int index) {
    GadenFrame frame = support::SampleFrame();
    frame.wind_index = index == 3 ? 1 : 0;
    frame.filaments = {{{0.5, 3.0, 0.75}, 20.0 + 5.0 * index}};
    return frame;
  }
  std::string Path(const std::string& name) const { return folder_.File(name); }
  void Write(const std::string& name, const std::string& bytes) {
    ASSERT_TRUE(MakeFolder(std::filesystem::path(Path(name)).parent_path().string()).ok());
    ASSERT_TRUE(WriteFile(Path(name), bytes).ok());
  }
  void WriteFrame(const std::string& folder, int number, const GadenFrame& frame) {
    Write(absl::StrCat(folder, "/iteration_", number), CompressZlib(support::FrameBytes3(frame)));
  }
  void ExpectError(absl::StatusCode code, const std::string& message) {
    const auto scene = ImportGaden(import_);
    EXPECT_EQ(scene.status().code(), code) << scene.status();
    EXPECT_THAT(std::string(scene.status().message()), HasSubstr(message));
  }

  const TempFolder folder_;
  const GadenEnvironment room_ = support::GadenRoom();
  GadenImport import_;
};

TEST_F(GadenSceneTest, MakesAValidSceneOfTheSlice) {
  const auto scene = ImportGaden(import_);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(ValidateScene(*scene).ok()) << ValidateScene(*scene);
  EXPECT_EQ(scene->name, "room");
  EXPECT_EQ(scene->geometry(), (GridGeometry{-1.0, 2.0, 0.5, 6, 5}));
  EXPECT_EQ(scene->sensor_height_m, 0.75);
  EXPECT_EQ(scene->start_pose, import_.start_pose);
  EXPECT_EQ(scene->occupancy[Cell(1, 1)], CellState::kFree);
  EXPECT_EQ(scene->occupancy[Cell(0, 1)], CellState::kOccupied);
  EXPECT_EQ(scene->occupancy[Cell(5, 2)], CellState::kOccupied);  // the outlet
  EXPECT_EQ(scene->sources, (std::vector<GasSource>{{0, 0.25, 3.25, 0.75, 0.0}}));
  EXPECT_EQ(scene->series.frames, 4);
  EXPECT_EQ(scene->series.dt_s, 2.0);
}

TEST_F(GadenSceneTest, TheMeanIsThatOfTheFrames) {
  const auto scene = ImportGaden(import_);
  ASSERT_TRUE(scene.ok()) << scene.status();
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += SliceGadenFrame(room_, FrameAt(i), 0.75)[Cell(3, 2)];
  EXPECT_GT(sum, 0.0);
  EXPECT_NEAR(scene->conc_mean_ppm[Cell(3, 2)], sum / 4.0, 1e-5 * sum);
  EXPECT_EQ(scene->conc_mean_ppm[Cell(5, 2)], 0.0F);
}

TEST_F(GadenSceneTest, TheWindIsTheMeanOverTheFrames) {
  const auto scene = ImportGaden(import_);
  ASSERT_TRUE(scene.ok()) << scene.status();
  ASSERT_TRUE(scene->wind.has_value());
  EXPECT_FLOAT_EQ(scene->wind->u_mps[Cell(2, 2)], 0.75F);
  EXPECT_FLOAT_EQ(scene->wind->v_mps[Cell(2, 2)], -0.5F);
  EXPECT_EQ(scene->wind->u_mps[Cell(0, 0)], 0.0F);  // in the wall
}

TEST_F(GadenSceneTest, ASceneMayHaveNoWind) {
  std::filesystem::remove_all(Path("wind"));
  const auto scene = ImportGaden(import_);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_FALSE(scene->wind.has_value());
}

TEST_F(GadenSceneTest, ReadsFoldersOfVersion2) {
  for (int i = 0; i < 4; ++i) {
    Write(absl::StrCat("old/iteration_", i + 1), CompressZlib(support::FrameBytes2(FrameAt(i))));
  }
  const auto scene = ImportGaden(import_);
  import_.results = {Path("old")};
  import_.environment = folder_.path();
  const auto old = ImportGaden(import_);
  ASSERT_TRUE(scene.ok() && old.ok()) << old.status();
  EXPECT_EQ(old->conc_mean_ppm, scene->conc_mean_ppm);
}

TEST_F(GadenSceneTest, SimulationsOfSeveralSourcesAddUp) {
  for (int i = 0; i < 4; ++i) WriteFrame("simulations/two/result", i, FrameAt(i));
  const auto one = ImportGaden(import_);
  import_.results.push_back(Path("simulations/two/result"));
  import_.rates_ppm_per_s = {600.0, 1000.0};
  const auto both = ImportGaden(import_);
  ASSERT_TRUE(one.ok() && both.ok()) << both.status();
  EXPECT_EQ(both->sources[1].rate_ppm_per_s, 1000.0);
  EXPECT_EQ(both->conc_mean_by_source_ppm[1], one->conc_mean_ppm);
  const float sum = 2.0F * one->conc_mean_ppm[Cell(3, 2)];
  EXPECT_FLOAT_EQ(both->conc_mean_ppm[Cell(3, 2)], sum);
}

TEST_F(GadenSceneTest, LeavesOutTheFirstFrames) {
  import_.skip_frames = 3;
  const auto scene = ImportGaden(import_);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->series.frames, 1);
  EXPECT_FLOAT_EQ(scene->wind->v_mps[Cell(2, 2)], -2.0F);
}

TEST_F(GadenSceneTest, NamesWhatIsMissing) {
  std::filesystem::remove(Path("simulations/one/result/iteration_2"));
  ExpectError(absl::StatusCode::kInvalidArgument, "result/iteration_2 is missing");
  import_.skip_frames = 9;
  std::filesystem::remove(Path("simulations/one/result/iteration_3"));
  ExpectError(absl::StatusCode::kNotFound, "2 files iteration_N, 9 of them to skip");
  import_.results = {Path("nowhere")};
  ExpectError(absl::StatusCode::kNotFound, "nowhere");
  std::filesystem::remove(Path("OccupancyGrid3D.csv"));
  ExpectError(absl::StatusCode::kNotFound, "OccupancyGrid3D.csv");
}

TEST_F(GadenSceneTest, NamesAWindFileThatIsMissing) {
  std::filesystem::remove(Path("wind/wind_iteration_1"));
  ExpectError(absl::StatusCode::kNotFound, "wind_iteration_1");
}

TEST_F(GadenSceneTest, NamesWhatDoesNotFit) {
  WriteFrame("simulations/two/result", 0, FrameAt(0));
  import_.results.push_back(Path("simulations/two/result"));
  ExpectError(absl::StatusCode::kInvalidArgument, "two/result has 1 frames");
  import_.results.pop_back();
  GadenFrame other = FrameAt(2);
  other.cells = {6, 5, 3};
  WriteFrame("simulations/one/result", 2, other);
  ExpectError(absl::StatusCode::kInvalidArgument, "iteration_2 is of 6 x 5 x 3 cells");
}

TEST_F(GadenSceneTest, NamesFieldsOutOfRange) {
  const GadenImport good = import_;
  import_.start_pose = {-0.9, 2.75, 0.0};  // in the wall
  ExpectError(absl::StatusCode::kInvalidArgument, "the start (-0.9, 2.75)");
  import_ = good;
  import_.height_m = 2.5;
  ExpectError(absl::StatusCode::kInvalidArgument, "height_m = 2.5 must be in [0, 2)");
  import_ = good;
  import_.frame_period_s = 0.0;
  ExpectError(absl::StatusCode::kInvalidArgument, "frame_period_s = 0");
  import_ = good;
  import_.skip_frames = -1;
  ExpectError(absl::StatusCode::kInvalidArgument, "skip_frames = -1");
  import_ = good;
  import_.rates_ppm_per_s = {1.0, 2.0};
  ExpectError(absl::StatusCode::kInvalidArgument, "2 rates for 1 result folders");
}

}  // namespace gaden_scene_test
}  // namespace plumescout::lab
