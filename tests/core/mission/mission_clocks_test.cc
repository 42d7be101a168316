// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Missions of robots whose clocks are wrong, and known to be.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/mission/mission.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_clocks_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
constexpr std::int64_t kBegin_ns = 1'800'000'000 * kSecond_ns;

MissionOptions Ageing() {
  MissionOptions options;
  options.gas.ageing_half_life_s = 60.0;
  return options;
}

// Three robots that look at a room and read gas, by clocks that are off by so much.
class Team {
 public:
  explicit Team(std::map<RobotId, std::int64_t> offsets_ns)
      : mission_(Mission::Create(Ageing()).value()), offsets_ns_(std::move(offsets_ns)) {
    std::int64_t lease = 0;
    for (const auto& [robot, offset_ns] : offsets_ns_) {
      Apply(RobotRegistered{robot, 0.2, ++lease});
      if (offset_ns != 0) Apply(ClockOffsetNoted{robot, offset_ns});
    }
  }

  void Look(int steps) {
    for (int k = 0; k < steps; ++k) {
      now_ns_ += kSecond_ns;
      double x_m = 1.0;
      for (const auto& [robot, offset_ns] : offsets_ns_) {
        const Pose2 pose{x_m, 2.0 + 0.05 * k, 0.0};
        const std::int64_t robot_ns = now_ns_ - offset_ns;
        Send(robot, {0, robot_ns, pose, support::ScanInBox(pose, 6.0, 4.0)});
        Send(robot, {0, robot_ns, pose, GasReading{10.0 * x_m + k}});
        x_m += 1.5;
      }
    }
    Apply(PosteriorRefreshed{mission_->sample_time_ns()});
  }
  void Send(const RobotId& robot, Observation observation) {
    observation.sequence = mission_->AppliedSequence(robot).value() + 1;
    Apply(ObservationReceived{robot, std::move(observation)});
  }
  void Apply(EventBody body) {
    const auto applied = mission_->Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    refused_ = applied->observation;
    log_.push_back(std::move(body));
  }

  Mission& mission() { return *mission_; }
  const absl::Status& refused() const { return refused_; }
  const std::vector<EventBody>& log() const { return log_; }
  std::int64_t now_ns() const { return now_ns_; }

 private:
  std::unique_ptr<Mission> mission_;
  std::map<RobotId, std::int64_t> offsets_ns_;
  std::vector<EventBody> log_;
  std::int64_t now_ns_ = kBegin_ns;
  absl::Status refused_;
};

TEST(MissionClocksTest, AnHourAheadAndAnHourBehindMakeTheFieldOfRightClocks) {
  Team right({{"a", 0}, {"b", 0}, {"c", 0}});
  Team wrong({{"a", kHour_ns}, {"b", 0}, {"c", -kHour_ns}});
  right.Look(20);
  wrong.Look(20);
  EXPECT_EQ(wrong.mission().sample_time_ns(), right.mission().sample_time_ns());
  const auto expected = right.mission().Snapshot();
  const auto actual = wrong.mission().Snapshot();
  EXPECT_TRUE(support::SameBytes(*actual->gas_mean_ppm, *expected->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*actual->gas_variance_ppm2, *expected->gas_variance_ppm2));
  for (const auto& [robot, record] : actual->robots) EXPECT_FALSE(record.state.silent) << robot;
}

TEST(MissionClocksTest, AReplayIsExactAndAStateGoesOn) {
  Team team({{"a", kHour_ns}, {"b", 0}, {"c", -kHour_ns}});
  team.Look(10);
  team.Send("a", {0, team.now_ns() - kHour_ns, {}, RobotStatus{0.4}});
  const auto replay = Mission::Create(Ageing()).value();
  for (const EventBody& body : team.log()) ASSERT_TRUE(replay->Apply(body).ok());
  EXPECT_EQ(replay->Digest(), team.mission().Digest());
  EXPECT_EQ(replay->StateOf("a")->clock_offset_ns, kHour_ns);
}

TEST(MissionClocksTest, OffsetsAreOfTheState) {
  Team one({{"a", kHour_ns}});
  Team other({{"a", kHour_ns + 1}});
  EXPECT_NE(one.mission().Digest(), other.mission().Digest());
}

TEST(MissionClocksTest, ATimeThatIsNoneIsRefusedWithWhatTheRobotSaid) {
  Team team({{"a", -kHour_ns}});
  team.Send("a", {0, kHour_ns - 1, {}, GasReading{1.0}});
  EXPECT_TRUE(absl::IsInvalidArgument(team.refused()));
  EXPECT_THAT(std::string(team.refused().message()),
              testing::HasSubstr("sample_time_ns = 3599999999999 of the robot's clock, -1 of the"));
  team.Send("a", {0, kHour_ns, {}, GasReading{1.0}});
  EXPECT_TRUE(team.refused().ok());
  EXPECT_EQ(team.mission().sample_time_ns(), 0);
}

TEST(MissionClocksTest, AGapOfNoTimeIsTakenWhateverTheOffset) {
  Team team({{"a", -kHour_ns}});
  team.Send("a", {0, 0, {}, SequenceGap{1, 5}});
  EXPECT_TRUE(team.refused().ok()) << team.refused();
  EXPECT_EQ(team.mission().AppliedSequence("a").value(), 5);
}

TEST(MissionClocksTest, AnAbsurdOffsetIsNoEvent) {
  Team team({{"a", 0}});
  const std::int64_t revision = team.mission().revision();
  EXPECT_TRUE(absl::IsInvalidArgument(
      team.mission().Apply(ClockOffsetNoted{"a", std::int64_t{1} << 62}).status()));
  EXPECT_TRUE(absl::IsNotFound(team.mission().Apply(ClockOffsetNoted{"z", 1}).status()));
  EXPECT_EQ(team.mission().revision(), revision);
}

}  // namespace mission_clocks_test
}  // namespace plumescout
