// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/line_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"

namespace plumescout::client {
namespace line_driver_test {

std::string PoseLine(std::int64_t time_ns, double x_m) {
  return absl::StrCat(R"({"type":"pose","time_ns":)", time_ns, R"(,"x_m":)", x_m,
                      R"(,"y_m":0,"yaw_rad":0})", "\n");
}
std::string GasLine(std::int64_t time_ns, double ppm) {
  return absl::StrCat(R"({"type":"gas","time_ns":)", time_ns, R"(,"concentration_ppm":)", ppm, "}",
                      "\n");
}

constexpr std::int64_t kTenth_ns = 100'000'000;

class LineDriverTest : public ::testing::Test {
 protected:
  void SetUp() override {
    signal(SIGPIPE, SIG_IGN);
    ASSERT_EQ(pipe(to_driver_.data()), 0);
    ASSERT_EQ(pipe(from_driver_.data()), 0);
  }
  void TearDown() override {
    for (const int fd : {to_driver_[0], to_driver_[1], from_driver_[0], from_driver_[1]}) {
      close(fd);
    }
  }

  LineDriver MakeDriver(absl::Duration patience = absl::Seconds(10)) {
    return LineDriver({.input_fd = to_driver_[0],
                       .output_fd = from_driver_[1],
                       .patience = patience,
                       .on_bad_line = [this](const absl::Status& s) { complaints_.push_back(s); }});
  }
  void Say(const std::string& text) {
    ASSERT_EQ(write(to_driver_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void EndProgram() {
    close(to_driver_[1]);
    to_driver_[1] = -1;
  }
  std::string Heard() {
    std::array<char, 4096> block;
    const ssize_t count = read(from_driver_[0], block.data(), block.size());
    return count > 0 ? std::string(block.data(), static_cast<std::size_t>(count)) : "";
  }

  std::array<int, 2> to_driver_;
  std::array<int, 2> from_driver_;
  std::vector<absl::Status> complaints_;
};

TEST_F(LineDriverTest, TakesClockAndPoseFromTheLines) {
  LineDriver driver = MakeDriver();
  Say(PoseLine(5 * kTenth_ns, 1.25));

  ASSERT_TRUE(driver.AwaitPose().ok());

  EXPECT_EQ(driver.now_ns(), 5 * kTenth_ns);
  EXPECT_EQ(driver.pose().x_m, 1.25);
}

TEST_F(LineDriverTest, AdvanceReadsUntilTheRobotsClockHasMovedOn) {
  LineDriver driver = MakeDriver();
  Say(PoseLine(0, 0.0));
  ASSERT_TRUE(driver.AwaitPose().ok());
  Say(PoseLine(kTenth_ns / 2, 0.5) + PoseLine(kTenth_ns, 1.0) + PoseLine(2 * kTenth_ns, 2.0));

  ASSERT_TRUE(driver.Advance(0.1).ok());

  EXPECT_EQ(driver.now_ns(), kTenth_ns);
  EXPECT_EQ(driver.pose().x_m, 1.0);
}

TEST_F(LineDriverTest, AReadingKeepsTheTimeAndPoseAtWhichItCame) {
  LineDriver driver = MakeDriver();
  Say(PoseLine(0, 1.0) + GasLine(kTenth_ns / 2, 7.0) + PoseLine(kTenth_ns, 2.0));
  ASSERT_TRUE(driver.AwaitPose().ok());
  ASSERT_TRUE(driver.Advance(0.1).ok());

  const auto reading = driver.ReadGas();

  ASSERT_TRUE(reading.ok()) << reading.status();
  EXPECT_EQ(reading->concentration_ppm, 7.0);
  EXPECT_EQ(driver.sample_time_ns(), kTenth_ns / 2);
  EXPECT_EQ(driver.sample_pose().x_m, 1.0);
  EXPECT_EQ(driver.pose().x_m, 2.0);
}

TEST_F(LineDriverTest, EachReadingIsTakenOnceAndTheNewestWins) {
  LineDriver driver = MakeDriver();
  Say(PoseLine(0, 0.0) + GasLine(1, 1.0) + GasLine(2, 2.0) + PoseLine(kTenth_ns, 0.0));
  ASSERT_TRUE(driver.AwaitPose().ok());
  ASSERT_TRUE(driver.Advance(0.1).ok());

  EXPECT_EQ(driver.ReadGas()->concentration_ppm, 2.0);
  EXPECT_TRUE(absl::IsUnavailable(driver.ReadGas().status()));
  EXPECT_TRUE(absl::IsUnavailable(driver.TakeScan().status()));
}

TEST_F(LineDriverTest, LinesMayComeInPieces) {
  LineDriver driver = MakeDriver();
  const std::string line = PoseLine(7, 3.0);
  Say(line.substr(0, 10));
  Say(line.substr(10));

  ASSERT_TRUE(driver.AwaitPose().ok());

  EXPECT_EQ(driver.pose().x_m, 3.0);
}

TEST_F(LineDriverTest, BadLinesAreCountedAndPassedOver) {
  LineDriver driver = MakeDriver();
  Say("hello\n" + GasLine(1, 1.0) + "{\"type\":\"pose\"}\n" + PoseLine(7, 3.0));

  ASSERT_TRUE(driver.AwaitPose().ok());

  EXPECT_EQ(driver.bad_lines(), 3);  // the reading came before any pose
  EXPECT_EQ(complaints_.size(), 3U);
  EXPECT_EQ(driver.pose().x_m, 3.0);
}

TEST_F(LineDriverTest, TheClockNeverRunsBackwards) {
  LineDriver driver = MakeDriver();
  Say(PoseLine(9 * kTenth_ns, 1.0) + PoseLine(3 * kTenth_ns, 2.0) + PoseLine(10 * kTenth_ns, 3.0));
  ASSERT_TRUE(driver.AwaitPose().ok());

  ASSERT_TRUE(driver.Advance(0.1).ok());

  EXPECT_EQ(driver.now_ns(), 10 * kTenth_ns);
}

TEST_F(LineDriverTest, AClockThatIsSetBackGoesOnFromThere) {
  LineDriver driver = MakeDriver();
  Say(PoseLine(100 * kTenth_ns, 1.0) + PoseLine(50 * kTenth_ns, 2.0) +
      PoseLine(51 * kTenth_ns, 3.0));
  ASSERT_TRUE(driver.AwaitPose().ok());

  ASSERT_TRUE(driver.Advance(0.1).ok());

  EXPECT_EQ(driver.now_ns(), 51 * kTenth_ns);
}

TEST_F(LineDriverTest, StatusIsTakenOnceAndNeedsNoPose) {
  LineDriver driver = MakeDriver();
  Say("{\"type\":\"status\",\"time_ns\":1,\"battery_share\":0.5}\n" + PoseLine(7, 3.0));
  ASSERT_TRUE(driver.AwaitPose().ok());

  EXPECT_EQ(driver.TakeStatus(), RobotStatus{0.5});
  EXPECT_FALSE(driver.TakeStatus().has_value());
  EXPECT_EQ(driver.bad_lines(), 0);
}

TEST_F(LineDriverTest, CommandsAreLines) {
  LineDriver driver = MakeDriver();

  ASSERT_TRUE(driver.Drive({.forward_mps = 0.5}).ok());

  EXPECT_EQ(Heard(), FormatTwistLine({.forward_mps = 0.5}));
}

TEST_F(LineDriverTest, WithoutAPoseForASecondTheRobotIsToldToStand) {
  LineDriver driver = MakeDriver();
  constexpr Twist kDrive{.forward_mps = 0.5};
  Say(PoseLine(kTenth_ns, 0.0) + GasLine(10 * kTenth_ns, 1.0) + GasLine(12 * kTenth_ns, 1.0) +
      PoseLine(13 * kTenth_ns, 0.5));
  ASSERT_TRUE(driver.AwaitPose().ok());
  ASSERT_TRUE(driver.Advance(0.9).ok());
  ASSERT_TRUE(driver.Drive(kDrive).ok());
  ASSERT_TRUE(driver.Advance(0.2).ok());
  ASSERT_TRUE(driver.Drive(kDrive).ok());
  ASSERT_TRUE(driver.Advance(0.1).ok());
  ASSERT_TRUE(driver.Drive(kDrive).ok());
  EXPECT_EQ(Heard(), FormatTwistLine(kDrive) + FormatTwistLine({}) + FormatTwistLine(kDrive));
}

TEST_F(LineDriverTest, AProgramThatDoesNotReadItsCommandsIsAnErrorInTheEnd) {
  LineDriver driver = MakeDriver(absl::Milliseconds(10));
  absl::Status status;
  for (int i = 0; status.ok() && i < 100'000; ++i) status = driver.Drive({.forward_mps = 0.5});
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
}

TEST_F(LineDriverTest, SilenceAndEndAreErrors) {
  LineDriver driver = MakeDriver(absl::Milliseconds(10));
  EXPECT_TRUE(absl::IsUnavailable(driver.AwaitPose()));

  EndProgram();
  EXPECT_TRUE(absl::IsUnavailable(driver.Advance(0.1)));
}

TEST_F(LineDriverTest, AProgramThatStopsReadingIsAnError) {
  LineDriver driver = MakeDriver();
  close(from_driver_[0]);
  from_driver_[0] = -1;

  EXPECT_TRUE(absl::IsUnavailable(driver.Drive({})));
}

TEST_F(LineDriverTest, ARealRobotCannotBePlaced) {
  LineDriver driver = MakeDriver();

  EXPECT_TRUE(absl::IsUnimplemented(driver.PlaceAt({})));
}

}  // namespace line_driver_test
}  // namespace plumescout::client
