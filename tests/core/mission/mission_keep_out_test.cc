// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Keep-out areas that change while the mission runs.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/mission/mission.h"
#include "core/types/error_reason.h"
#include "formats/journal/event_codec.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_keep_out_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr Pose2 kStart{1.0, 1.5, 0.0};  // where robot a stands in a room of 4 by 3 m

Polygon Box(const std::string& name, double x0_m, double y0_m, double x1_m, double y1_m) {
  return {{{x0_m, y0_m}, {x1_m, y0_m}, {x1_m, y1_m}, {x0_m, y1_m}}, name};
}
const Polygon kSpill = Box("spill", 2.0, 1.0, 3.0, 2.0);

class MissionKeepOut : public testing::Test {
 protected:
  void Start(const MissionOptions& options = {}) {
    mission_ = Mission::Create(options).value();
    Do(RobotRegistered{"a", 0.2, 1});
    for (std::int64_t sequence = 1; sequence <= 3; ++sequence) {
      const Scan scan = support::ScanInBox(kStart, 4.0, 3.0);
      Do(ObservationReceived{"a", {sequence, sequence * kSecond_ns, kStart, scan}});
    }
  }
  void Do(const EventBody& body) {
    const auto applied = mission_->Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    events_.push_back(body);
  }
  std::string RefusalOf(const KeepOutChanged& change) {
    const std::uint64_t before = mission_->Digest();
    const absl::Status status = mission_->Apply(change).status();
    EXPECT_FALSE(status.ok());
    EXPECT_EQ(mission_->Digest(), before);
    return std::string(ErrorReason(status));
  }
  int Open() const {
    const auto belief = mission_->Snapshot();
    int open = 0;
    for (std::size_t i = 0; i < belief->traversable->size(); ++i) {
      open += (*belief->traversable)[i];
    }
    return open;
  }

  std::unique_ptr<Mission> mission_;
  std::vector<EventBody> events_;
};

TEST_F(MissionKeepOut, AnAreaClosesItsCellsUntilItIsDeleted) {
  Start();
  const auto before = mission_->Snapshot();
  const int open = Open();
  Do(KeepOutChanged{{}, {kSpill}});
  EXPECT_EQ(Open(), open - 100) << "1 m by 1 m of 0.1 m, all of it open";
  const auto closed = mission_->Snapshot();
  EXPECT_TRUE(support::SameBytes(*closed->occupancy, *before->occupancy)) << "mapped all the same";
  EXPECT_EQ(MakeMapStatus(*closed).keep_out, std::vector<Polygon>{kSpill});
  EXPECT_TRUE(before->options->keep_out.empty()) << "who plans on it still sees what it was";
  Do(KeepOutChanged{{"spill"}, {}});
  EXPECT_TRUE(support::SameBytes(*mission_->Snapshot()->traversable, *before->traversable));
  EXPECT_TRUE(mission_->options().keep_out.empty());
}

TEST_F(MissionKeepOut, AreasOfTheOptionsHaveNames) {
  MissionOptions options;
  options.keep_out = {Box("", 2.0, 1.0, 3.0, 2.0), Box("ramp", 3.0, 1.0, 3.5, 2.0)};
  Start(options);
  EXPECT_EQ(mission_->options().keep_out[0].name, "area-1");
  EXPECT_EQ(RefusalOf({{}, {Box("ramp", 0, 0, 1, 1)}}), reason::kKeepOutAreaExists);
  EXPECT_EQ(RefusalOf({{"spill"}, {}}), reason::kKeepOutAreaNotFound);
  Do(KeepOutChanged{{"area-1"}, {}});
  EXPECT_EQ(mission_->options().keep_out.size(), 1u);
}

TEST_F(MissionKeepOut, SomeRobotsHomeStaysOpen) {
  Start();
  const Polygon around_a = Box("around-a", 0.5, 1.0, 1.5, 2.0);
  EXPECT_EQ(RefusalOf({{}, {around_a}}), reason::kKeepOutCoversHome) << "no other robot is there";
  Do(RobotRegistered{"b", 0.2, 2});
  EXPECT_EQ(RefusalOf({{}, {around_a}}), reason::kKeepOutCoversHome) << "nobody knows b's home";
  Do(ObservationReceived{"b", {1, kSecond_ns, {3.5, 2.5, 0.0}, GasReading{1.0, 0.0}}});
  Do(KeepOutChanged{{}, {around_a}});
  EXPECT_EQ(RefusalOf({{}, {Box("around-b", 3.0, 2.0, 4.0, 3.0)}}), reason::kKeepOutCoversHome);
}

TEST_F(MissionKeepOut, AMissionsHomeStaysOpenUnlessItBeganClosed) {
  MissionOptions options;
  options.home = Point2{3.5, 2.5};
  Start(options);
  const Polygon around_home = Box("around-home", 3.0, 2.0, 4.0, 3.0);
  EXPECT_EQ(RefusalOf({{}, {around_home}}), reason::kKeepOutCoversHome);
  options.keep_out = {around_home};
  Start(options);
  Do(KeepOutChanged{{}, {kSpill}});
}

TEST_F(MissionKeepOut, WaysAreCheckedThatWereFoundBefore) {
  Start();
  Plan plan;
  plan.robot = "a";
  plan.belief_revision = mission_->revision();
  plan.trajectory.waypoints = {{kStart}, {{3.5, 1.5, 0.0}}};
  EXPECT_EQ(mission_->FindKeptOut(plan), std::nullopt);
  Do(KeepOutChanged{{}, {kSpill}});
  const auto place = mission_->FindKeptOut(plan);
  ASSERT_TRUE(place.has_value());
  EXPECT_NEAR(place->x_m, 2.05, 1e-9) << "the first closed cell";
  plan.belief_revision = mission_->revision();
  EXPECT_EQ(mission_->FindKeptOut(plan), std::nullopt) << "it was found beside the area";
}

TEST_F(MissionKeepOut, AReplayOfTheJournalGivesTheSame) {
  Start();
  Do(KeepOutChanged{{}, {kSpill, Box("ramp", 3.0, 0.5, 3.5, 1.0)}});
  Do(KeepOutChanged{{"spill"}, {Box("spill", 2.5, 1.0, 3.0, 2.0)}});
  const auto replay = Mission::Create({}).value();
  std::int64_t number = 0;
  for (const EventBody& body : events_) {
    const auto event = DecodeEvent(EncodeEvent({++number, body}));
    ASSERT_TRUE(event.ok()) << event.status();
    ASSERT_TRUE(replay->Apply(event->body).ok());
  }
  EXPECT_EQ(replay->Digest(), mission_->Digest());
  EXPECT_TRUE(
      support::SameBytes(*replay->Snapshot()->traversable, *mission_->Snapshot()->traversable));
}

TEST_F(MissionKeepOut, ASavedMissionHasTheAreasOfThen) {
  MissionOptions options;
  options.keep_out = {Box("ramp", 3.0, 0.5, 3.5, 1.0)};
  Start(options);
  const std::uint64_t as_it_began = mission_->Digest();
  Do(KeepOutChanged{{"ramp"}, {kSpill}});
  EXPECT_NE(mission_->Digest(), as_it_began);
  const auto restored = Mission::Restore(options, mission_->SaveState().value());
  ASSERT_TRUE(restored.ok()) << restored.status();
  EXPECT_EQ((*restored)->Digest(), mission_->Digest());
  EXPECT_EQ((*restored)->options().keep_out, std::vector<Polygon>{kSpill});
  EXPECT_TRUE(support::SameBytes(*(*restored)->Snapshot()->traversable,
                                 *mission_->Snapshot()->traversable));
  Do(KeepOutChanged{{"spill"}, {}});
  ASSERT_TRUE((*restored)->Apply(KeepOutChanged{{"spill"}, {}}).ok());
  EXPECT_EQ((*restored)->Digest(), mission_->Digest()) << "none is not the same as those it had";
}

}  // namespace mission_keep_out_test
}  // namespace plumescout
