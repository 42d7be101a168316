// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/bag_intake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include "tests/lab/bags/bag_files.h"

namespace plumescout::lab {
namespace bag_intake_test {

using ::testing::Contains;
using ::testing::HasSubstr;

class BagIntakeTest : public ::testing::Test {
 protected:
  void TakeAll(const std::vector<BagMessage>& messages) {
    for (const BagMessage& message : messages) ASSERT_TRUE(intake_.Take(message).ok());
    ASSERT_TRUE(intake_.Finish().ok());
  }

  std::vector<Observation> taken_;
  std::vector<std::string> complaints_;
  absl::Status sink_status_;
  BagIntake intake_{{},
                    {},
                    [this](const std::string& about, const absl::Status& why) {
                      complaints_.push_back(absl::StrCat(about, ": ", why.message()));
                    },
                    [this](std::int64_t time_ns, const Pose2& pose, ObservationPayload payload) {
                      taken_.push_back({0, time_ns, pose, std::move(payload)});
                      return sink_status_;
                    }};
};

TEST_F(BagIntakeTest, PlacesWhatWasRecorded) {
  TakeAll(RoomBag(3));
  ASSERT_EQ(taken_.size(), 6u);
  EXPECT_TRUE(std::holds_alternative<Scan>(taken_[0].payload));
  EXPECT_NEAR(taken_[0].pose.x_m, 1.5 + 0.1 * std::cos(0.5), 1e-9);
  EXPECT_EQ(std::get<GasReading>(taken_[1].payload).concentration_ppm, 7.0);
  EXPECT_NEAR(taken_[1].pose.x_m, 1.5, 1e-9);
  EXPECT_LT(taken_[1].sample_time_ns, taken_[2].sample_time_ns);
  EXPECT_EQ(intake_.counters().bad, 0);
}

TEST_F(BagIntakeTest, WhatMakesNoSenseIsNamedAndPassedOver) {
  std::vector<BagMessage> messages = RoomBag(2);
  messages[2].type = "std_msgs/msg/String";  // a scan
  messages[3].cdr = "no CDR";                // a gas reading
  messages.push_back(messages[5]);           // the second scan again
  messages.back().log_time_ns += 1;
  TakeAll(messages);
  EXPECT_EQ(taken_.size(), 2u);
  EXPECT_EQ(intake_.counters().bad, 3);
  EXPECT_THAT(complaints_, Contains(HasSubstr("/scan: its type is std_msgs/msg/String, not ")));
  EXPECT_THAT(complaints_, Contains(HasSubstr("is not plain CDR")));
  EXPECT_THAT(complaints_, Contains(HasSubstr("time runs backwards")));
}

TEST_F(BagIntakeTest, WhatIsNeverPlacedIsGivenUp) {
  std::vector<BagMessage> messages = RoomBag(2);
  messages.erase(messages.begin());  // the scanner's mount
  TakeAll(messages);
  EXPECT_EQ(intake_.counters().scans, 0);
  EXPECT_EQ(intake_.counters().gas_readings, 2);
  EXPECT_EQ(intake_.counters().unplaced, 2);
}

TEST_F(BagIntakeTest, JumpOfSlamIsACorrection) {
  std::vector<BagMessage> messages = RoomBag(3);
  const std::int64_t time_ns = messages.back().log_time_ns;
  messages.push_back(Recorded(
      "/tf", time_ns, ros::TfMessage{{client::Stamped("map", "odom", time_ns, {3.0, 0.0, 0.0})}}));
  TakeAll(messages);
  EXPECT_EQ(intake_.jumps(), 1);
  ASSERT_EQ(taken_.size(), 7u);
  ASSERT_TRUE(std::holds_alternative<PoseCorrection>(taken_.back().payload));
  EXPECT_NEAR(taken_.back().pose.x_m, 3.5, 1e-9);
}

TEST_F(BagIntakeTest, ErrorsOfTheSinkEndIt) {
  sink_status_ = absl::InternalError("full");
  const std::vector<BagMessage> messages = RoomBag(1);
  EXPECT_TRUE(intake_.Take(messages[0]).ok());
  EXPECT_TRUE(intake_.Take(messages[1]).ok());
  EXPECT_EQ(intake_.Take(messages[2]), sink_status_);
}

}  // namespace bag_intake_test
}  // namespace plumescout::lab
