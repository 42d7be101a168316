// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/scene_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "formats/file_io.h"
#include "formats/zlib_codec.h"
#include "lab/formats/scene_folder.h"
#include "lab/sim/layout_writer.h"
#include "lab/sim/layout_yaml.h"
#include "tests/lab/sim/small_scene.h"
#include "tests/support/gaden_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace scene_command_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// The command line as a user types it; paths are within a fresh folder.
class SceneCommandTest : public ::testing::Test {
 protected:
  // What the program would say on standard error: nothing if all went well.
  std::string Run(const std::string& arguments) {
    CLI::App app;
    absl::Status status;
    AddSceneCommand(app, status);
    try {
      app.parse(absl::StrCat("scene ", arguments));
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return std::string(status.message());
  }
  std::string Path(const std::string& name) const { return folder_.File(name); }
  bool Exists(const std::string& name) const { return std::filesystem::exists(Path(name)); }
  std::string Bytes(const std::string& name) const {
    constexpr std::uint64_t kMaxBytes = 1 << 24;
    return ReadFile(Path(name), kMaxBytes).value_or("");
  }
  // `make` of a layout file, to the folder "out".
  std::string Make(const std::string& layout, const std::string& options = "") {
    return Run(absl::StrCat("make ", Path(layout), " --out ", Path("out"), " ", options));
  }
  void WriteSmallLayout(const std::string& name) {
    ASSERT_TRUE(WriteLayout(SmallLayout(), Path(name)).ok());
  }

 private:
  const TempFolder folder_;
};

constexpr char kShort[] = "--frames 3 --warm-up-s 1";

TEST_F(SceneCommandTest, MakesAFolderThatReads) {
  WriteSmallLayout("small.yaml");
  ASSERT_EQ(Make("small.yaml", kShort), "");
  const auto scene = ReadScene(Path("out"));
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->name, "small");
  EXPECT_EQ(scene->start_pose, SmallLayout().start_pose);
  EXPECT_EQ(scene->series.frames, 3);
  EXPECT_TRUE(scene->wind.has_value());
}

TEST_F(SceneCommandTest, TheSeedMovesTheGas) {
  WriteSmallLayout("small.yaml");
  const auto mean_of = [&](const char* seed) {
    EXPECT_EQ(Make("small.yaml", absl::StrCat(kShort, " --seed ", seed)), "");
    const auto scene = ReadScene(Path("out"));
    EXPECT_TRUE(scene.ok()) << scene.status();
    return scene.ok() ? scene->conc_mean_ppm.values() : std::vector<float>{};
  };
  const std::vector<float> first = mean_of("1");
  EXPECT_TRUE(mean_of("1") == first);
  EXPECT_FALSE(mean_of("2") == first);
}

TEST_F(SceneCommandTest, OfABadLayoutNamesFileAndValueAndWritesNothing) {
  const std::string yaml =
      absl::StrReplaceAll(FormatLayout(SmallLayout()), {{"resolution_m: ", "resolution_m: -"}});
  ASSERT_TRUE(WriteFile(Path("bad.yaml"), yaml).ok());
  EXPECT_THAT(Make("bad.yaml", kShort),
              AllOf(HasSubstr("bad.yaml: "), HasSubstr("resolution_m = -0.1 must be")));
  EXPECT_THAT(Make("absent.yaml", kShort), HasSubstr("absent.yaml: "));
  EXPECT_FALSE(Exists("out"));
}

TEST_F(SceneCommandTest, OfABuildingThatDoesNotFitNamesFileAndValueAndWritesNothing) {
  Layout layout = SmallLayout();
  layout.start_pose = {2.0, 1.5, 0.0};  // in the box
  ASSERT_TRUE(WriteLayout(layout, Path("walled.yaml")).ok());
  EXPECT_THAT(Make("walled.yaml", kShort),
              AllOf(HasSubstr("walled.yaml"), HasSubstr("start_pose"), HasSubstr("2, 1.5")));
  EXPECT_FALSE(Exists("out"));
}

TEST_F(SceneCommandTest, OptionsOutOfRangeAreNamedAndNothingIsWritten) {
  WriteSmallLayout("small.yaml");
  EXPECT_THAT(Make("small.yaml", "--frames 0"), HasSubstr("frames = 0 must be"));
  EXPECT_THAT(Make("small.yaml", "--warm-up-s -1"), HasSubstr("warm_up_s = -1 must be"));
  EXPECT_THAT(Make("small.yaml", "--warm-up-s nan"), HasSubstr("warm_up_s = nan must be"));
  EXPECT_THAT(Run(absl::StrCat("generate --frames -3 --out ", Path("out"))),
              HasSubstr("frames = -3 must be"));
  EXPECT_FALSE(Exists("out"));
}

TEST_F(SceneCommandTest, ArgumentsThatDoNotReadAreNamedWithTheirValue) {
  EXPECT_THAT(Make("small.yaml", "--frames many"), AllOf(HasSubstr("--frames"), HasSubstr("many")));
  EXPECT_THAT(Make("small.yaml", "--seed 1.5"), AllOf(HasSubstr("--seed"), HasSubstr("1.5")));
  EXPECT_THAT(Run("make small.yaml"), HasSubstr("--out"));
  EXPECT_THAT(Run("generate --count 0"), AllOf(HasSubstr("--count"), HasSubstr("0")));
  EXPECT_THAT(Run(absl::StrCat("generate --layout-only --seed -1 --out ", Path("out"))),
              AllOf(HasSubstr("--seed"), HasSubstr("-1")));
  EXPECT_THAT(Run("show " + Path("nowhere")), AllOf(HasSubstr("folder"), HasSubstr("nowhere")));
  EXPECT_NE(Run(""), "");  // make, generate, show or import?
}

TEST_F(SceneCommandTest, GeneratesALayoutForEachSeed) {
  ASSERT_EQ(Run(absl::StrCat("generate --layout-only --seed 5 --count 2 --out ", Path("out"))), "");
  for (const char* name : {"out/generated_5", "out/generated_6"}) {
    const auto layout = ReadLayout(Path(absl::StrCat(name, ".yaml")));
    EXPECT_TRUE(layout.ok()) << layout.status();
    EXPECT_FALSE(Exists(name)) << "no scenes were asked for";
  }
  EXPECT_NE(Bytes("out/generated_5.yaml"), Bytes("out/generated_6.yaml"));
}

TEST_F(SceneCommandTest, ShowsASceneAsAPicture) {
  ASSERT_TRUE(WriteScene(SmallScene(), Path("scene")).ok());
  const std::string show = absl::StrCat("show --out ", Path("below/picture.png"), " ");
  ASSERT_EQ(Run(show + Path("scene")), "");
  EXPECT_THAT(Bytes("below/picture.png"), StartsWith("\x89PNG"));
}

TEST_F(SceneCommandTest, ShowsNothingOfAFolderThatIsNoScene) {
  ASSERT_TRUE(MakeFolder(Path("empty")).ok());
  EXPECT_THAT(Run(absl::StrCat("show --out ", Path("picture.png"), " ", Path("empty"))),
              HasSubstr("empty"));
  EXPECT_FALSE(Exists("picture.png"));
}

// Two frames of GADEN in a room without wind.
class SceneImportTest : public SceneCommandTest {
 protected:
  void SetUp() override {
    GadenFrame frame = support::SampleFrame();
    frame.filaments = {{{0.5, 3.0, 0.75}, 20.0}};
    const std::string bytes = CompressZlib(support::FrameBytes3(frame));
    ASSERT_TRUE(MakeFolder(Path("result")).ok());
    ASSERT_TRUE(WriteFile(Path("result/OccupancyGrid3D.csv"),
                          support::EnvironmentText(support::GadenRoom()))
                    .ok());
    for (const char* name : {"result/iteration_0", "result/iteration_1"}) {
      ASSERT_TRUE(WriteFile(Path(name), bytes).ok());
    }
  }
  std::string Import(const std::string& options) {
    return Run(absl::StrCat("import-gaden ", Path("result"), " --height-m 0.75 --out ",
                            Path("room/"), " ", options));
  }
};

TEST_F(SceneImportTest, ConvertsResultsToAFolderThatReads) {
  ASSERT_EQ(Import("--start -0.25 2.75 1.5"), "");
  const auto scene = ReadScene(Path("room"));
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->name, "room");
  EXPECT_EQ(scene->series.frames, 2);
  EXPECT_EQ(scene->start_pose, (Pose2{-0.25, 2.75, 1.5}));
}

TEST_F(SceneImportTest, BadArgumentsAreNamedAndNothingIsWritten) {
  const std::string start = "--start -0.25 2.75 ";
  EXPECT_THAT(Import("--start -0.25"), HasSubstr("--start"));
  EXPECT_THAT(Import(start + "--frame-period-s 0"), HasSubstr("frame_period_s = 0 must be"));
  EXPECT_THAT(Import(start + "--skip-frames -1"), HasSubstr("skip_frames = -1 must be"));
  EXPECT_THAT(Import(start + "--environment " + Path("nowhere")),
              AllOf(HasSubstr("--environment"), HasSubstr("nowhere")));
  EXPECT_FALSE(Exists("room"));
}

}  // namespace scene_command_test
}  // namespace plumescout::lab
