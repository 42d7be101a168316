// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/gaden_environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_replace.h"
#include "formats/file_io.h"
#include "tests/support/gaden_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace gaden_environment_test {

using testing::HasSubstr;

class GadenEnvironmentFile : public testing::Test {
 protected:
  absl::StatusOr<GadenEnvironment> Read(const std::string& text) {
    EXPECT_TRUE(WriteFile(path_, text).ok());
    return ReadGadenEnvironment(path_);
  }
  void ExpectError(const std::string& text, absl::StatusCode code, const std::string& message) {
    const auto environment = Read(text);
    EXPECT_EQ(environment.status().code(), code) << environment.status();
    EXPECT_THAT(std::string(environment.status().message()), HasSubstr(path_));
    EXPECT_THAT(std::string(environment.status().message()), HasSubstr(message));
  }
  void ExpectInvalid(const std::string& from, const std::string& to, const std::string& message) {
    const std::string text = absl::StrReplaceAll(text_, {{from, to}});
    ASSERT_NE(text, text_);
    ExpectError(text, absl::StatusCode::kInvalidArgument, message);
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("OccupancyGrid3D.csv");
  const GadenEnvironment room_ = support::GadenRoom();
  const std::string text_ = support::EnvironmentText(room_);
};

TEST_F(GadenEnvironmentFile, ReadsTheBoxAndEveryCell) {
  const auto environment = Read(text_);
  ASSERT_TRUE(environment.ok()) << environment.status();
  EXPECT_EQ(environment->cells, room_.cells);
  EXPECT_EQ(environment->min, room_.min);
  EXPECT_EQ(environment->cell_size_m, 0.5);
  EXPECT_EQ(environment->states, room_.states);
}

TEST_F(GadenEnvironmentFile, ReadsLinesOfAllEndings) {
  EXPECT_TRUE(Read(absl::StrReplaceAll(text_, {{"\n", "\r\n"}})).ok());
  EXPECT_TRUE(Read(text_ + "\n").ok());
}

TEST_F(GadenEnvironmentFile, PointsAreInTheCellThatHoldsThem) {
  EXPECT_TRUE(room_.IsFree(-0.5, 2.5, 0.5));      // on the corner of the first free cell
  EXPECT_FALSE(room_.IsFree(-0.51, 2.5, 0.5));    // in the wall
  EXPECT_FALSE(room_.IsFree(1.75, 3.25, 0.75));   // in the outlet
  EXPECT_FALSE(room_.IsFree(1e300, 3.25, 0.75));  // far outside
  EXPECT_FALSE(room_.IsFree(-1.2, 3.25, 0.75));
}

TEST_F(GadenEnvironmentFile, ATruncatedFileIsNamed) {
  ExpectError("", absl::StatusCode::kDataLoss, "ends after line 0");
  ExpectError(text_.substr(0, text_.size() - 2), absl::StatusCode::kDataLoss, "ends after line 31");
}

TEST_F(GadenEnvironmentFile, AFileThatGoesOnIsNamed) {
  ExpectError(text_ + "0 0\n", absl::StatusCode::kDataLoss, "goes on after the last cell");
}

TEST_F(GadenEnvironmentFile, ABadHeaderIsNamedByLineAndValue) {
  ExpectInvalid("#env_min(m)", "#min", ":1: \"#min -1 2 0\" must be #env_min and 3 numbers");
  ExpectInvalid("#env_min(m) -1", "#env_min(m) nan", ":1: ");
  ExpectInvalid("#num_cells 6", "#num_cells 0", ":3: num_cells 0");
  ExpectInvalid("#num_cells 6", "#num_cells 6.5", ":3: num_cells 6.5");
  ExpectInvalid("#num_cells 6 5", "#num_cells 600000 500", ":3: 1.2e+09 cells");
  ExpectInvalid("#cell_size(m) 0.5", "#cell_size(m) -0.5", ":4: cell_size -0.5");
}

TEST_F(GadenEnvironmentFile, ABadCellIsNamedByLineAndValue) {
  ExpectInvalid("2 ", "7 ", "cell \"7\" must be");
  ExpectInvalid("1 0 0 0 1 \n", "1 0 0 1 \n", ":13: 4 cells, num_cells says 5");
  ExpectInvalid(";\n", "\n", ":11: a layer must end");
}

TEST_F(GadenEnvironmentFile, AMissingFileIsNamed) {
  const auto environment = ReadGadenEnvironment(folder_.File("none.csv"));
  EXPECT_EQ(environment.status().code(), absl::StatusCode::kNotFound);
}

}  // namespace gaden_environment_test
}  // namespace plumescout::lab
