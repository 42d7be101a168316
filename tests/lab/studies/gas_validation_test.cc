// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/gas_validation.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "lab/formats/scene_folder.h"
#include "lab/sim/scene_maker.h"
#include "tests/lab/sim/small_layout.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace gas_validation_test {

std::map<std::string, double> FiguresOf(const Study& study) {
  return {study.summary.figures.begin(), study.summary.figures.end()};
}

const Study& QuickStudy() {
  static const Study study = [] {
    ExperimentOptions options;
    options.quick = true;
    return *RunGasValidation(options);
  }();
  return study;
}

TEST(GasValidation, FilamentsAgreeWithTheEquation) {
  const auto figures = FiguresOf(QuickStudy());
  EXPECT_GE(figures.at("least_log_correlation"), 0.85);
  EXPECT_EQ(figures.at("building_mass_imbalance_filaments"), 0.0);
}

TEST(GasValidation, FilamentsAreTheGaussianPlumeUpToChance) {
  EXPECT_LE(FiguresOf(QuickStudy()).at("gaussian_plume_largest_deviation_in_tolerances"), 1.0);
}

TEST(GasValidation, SaysThatNoScenesWereGiven) {
  bool said = false;
  for (const std::string& note : QuickStudy().figures.notes) {
    said |= note.find("No scene folders were given") != std::string::npos;
  }
  EXPECT_TRUE(said);
  EXPECT_EQ(QuickStudy().figures.panels.size(), 2u);
}

// Our own scene's gas follows our own laws, but for its opening: closed in its map.
TEST(GasValidation, ComparesScenesThatItIsGiven) {
  SceneMakerOptions maker;
  maker.wind.flow_s = 4.0;
  maker.warm_up_s = 30.0;
  maker.frames = 60;
  const TempFolder folder;
  ASSERT_TRUE(WriteScene(*MakeScene(SmallLayout(), maker), folder.File("small")).ok());
  ExperimentOptions options;
  options.quick = true;
  options.scenes = {folder.File("small")};
  const auto study = RunGasValidation(options);
  ASSERT_TRUE(study.ok()) << study.status();
  EXPECT_EQ(study->figures.panels.size(), 5u);
  EXPECT_GT(FiguresOf(*study).at("small_steady_log_correlation"), 0.8);
  EXPECT_TRUE(FiguresOf(*study).contains("small_filaments_log_correlation"));
}

TEST(GasValidation, NamesAFolderThatIsNoScene) {
  ExperimentOptions options;
  options.quick = true;
  options.scenes = {"no/such/scene"};
  const absl::Status status = RunGasValidation(options).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_NE(status.message().find("no/such/scene"), std::string::npos);
}

}  // namespace gas_validation_test
}  // namespace plumescout::lab
