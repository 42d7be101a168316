// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What is kept of plans is all that a mission needs of them.

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/mission/mission.h"
#include "core/plan/strategy.h"
#include "formats/journal/event_codec.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace slim_plan_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Missions that hear of the same events, one of whole plans, the other of what was kept of them.
class SlimPlanTest : public ::testing::Test {
 protected:
  SlimPlanTest() {
    MissionOptions options;
    options.robot_silence_s = 8.0;
    mission_ = std::make_unique<Mission>(options);
    slim_ = std::make_unique<Mission>(options);
  }

  PlanId Apply(const EventBody& body) {
    const auto applied = mission_->Apply(body);
    EXPECT_TRUE(applied.ok()) << applied.status();
    if (!applied.ok()) return 0;
    const std::string bytes = EncodeEvent({applied->revision, body}, PlanDetail::kForReplay);
    whole_bytes_ += EncodeEvent({applied->revision, body}).size();
    slim_bytes_ += bytes.size();
    const auto event = DecodeEvent(bytes);
    EXPECT_TRUE(event.ok()) << event.status();
    const auto again = slim_->Apply(event->body);
    EXPECT_TRUE(again.ok()) << again.status();
    EXPECT_EQ(again->revision, applied->revision);
    EXPECT_EQ(again->plan_id, applied->plan_id);
    ExpectSame();
    return applied->plan_id;
  }
  void Observe(const RobotId& robot, std::int64_t now_ns, const Pose2& pose) {
    std::int64_t& sequence = robot == "a" ? sequence_a_ : sequence_b_;
    const Scan scan = support::ScanInBox(pose, 6.0, 4.0);
    Apply(ObservationReceived{robot, {++sequence, now_ns, pose, scan}});
    Apply(ObservationReceived{robot, {++sequence, now_ns, pose, GasReading{2.0, 0.0}}});
    Apply(PosteriorRefreshed{now_ns});
  }
  Plan PlanBy(const std::string& strategy, const RobotId& robot) {
    PlanningOptions options;
    options.strategy = strategy;
    EXPECT_TRUE(ApplyStrategyRow(options).ok());
    const auto made = MakeStrategy(options);
    EXPECT_TRUE(made.ok()) << made.status();
    PlanRequest request;
    request.robot = robot;
    auto plan = (*made)->Plan(*mission_->Snapshot(), request, NeverStop());
    EXPECT_TRUE(plan.ok()) << plan.status();
    return plan.ok() ? *std::move(plan) : Plan{};
  }
  void ExpectSame() const;

  std::unique_ptr<Mission> mission_;
  std::unique_ptr<Mission> slim_;
  std::int64_t sequence_a_ = 0;
  std::int64_t sequence_b_ = 0;
  std::size_t whole_bytes_ = 0;
  std::size_t slim_bytes_ = 0;
};

void ExpectSameRecord(const RobotRecord& record, const RobotRecord& expected) {
  EXPECT_EQ(record.state, expected.state);
  EXPECT_EQ(record.plans_issued, expected.plans_issued);
  EXPECT_EQ(record.fruitless_fallbacks, expected.fruitless_fallbacks);
  EXPECT_EQ(record.first_place, expected.first_place);
  EXPECT_EQ(record.travelled_m, expected.travelled_m);
  EXPECT_EQ(record.last_plan, expected.last_plan);
  EXPECT_EQ(record.live_goal, expected.live_goal);
  EXPECT_EQ(record.live_arrival_ns, expected.live_arrival_ns);
  ASSERT_EQ(record.live_trajectory == nullptr, expected.live_trajectory == nullptr);
  if (record.live_trajectory != nullptr) {
    EXPECT_EQ(*record.live_trajectory, *expected.live_trajectory);
  }
}

void SlimPlanTest::ExpectSame() const {
  const auto belief = slim_->Snapshot();
  const auto expected = mission_->Snapshot();
  EXPECT_EQ(belief->revision, expected->revision);
  EXPECT_EQ(belief->phase, expected->phase);
  EXPECT_EQ(belief->next_map_update_ns, expected->next_map_update_ns);
  EXPECT_TRUE(support::SameBytes(*belief->occupancy, *expected->occupancy));
  EXPECT_TRUE(support::SameBytes(*belief->gas_mean_ppm, *expected->gas_mean_ppm));
  ASSERT_EQ(belief->robots.size(), expected->robots.size());
  for (const auto& [id, record] : expected->robots) {
    SCOPED_TRACE(id);
    ExpectSameRecord(belief->robots.at(id), record);
  }
  ASSERT_EQ(belief->claims.size(), expected->claims.size());
  for (std::size_t i = 0; i < expected->claims.size(); ++i) {
    EXPECT_EQ(belief->claims[i].robot, expected->claims[i].robot);
    EXPECT_EQ(belief->claims[i].plan, expected->claims[i].plan);
    EXPECT_EQ(belief->claims[i].goal, expected->claims[i].goal);
    EXPECT_EQ(belief->claims[i].expires_ns, expected->claims[i].expires_ns);
  }
  ASSERT_EQ(belief->set_aside.size(), expected->set_aside.size());
  for (std::size_t i = 0; i < expected->set_aside.size(); ++i) {
    EXPECT_EQ(belief->set_aside[i].goal, expected->set_aside[i].goal);
    EXPECT_EQ(belief->set_aside[i].reason, expected->set_aside[i].reason);
    EXPECT_EQ(belief->set_aside[i].expires_ns, expected->set_aside[i].expires_ns);
  }
}

TEST_F(SlimPlanTest, AMissionIsTheSameWithWhatIsKept) {
  Apply(RobotRegistered{"a", 0.2, 1});
  Apply(RobotRegistered{"b", 0.2, 2});
  constexpr ProgressOutcome kOutcomes[] = {ProgressOutcome::kReached, ProgressOutcome::kBlocked,
                                           ProgressOutcome::kAborted};
  Pose2 pose{1.0, 1.0, 0.0};
  int chosen = 0;
  for (int step = 0; step < 12; ++step) {
    const std::int64_t now_ns = (step + 1) * kSecond_ns;
    Observe("a", now_ns, pose);
    if (step < 3) Observe("b", now_ns, {5.0, 3.0, 0.5});  // and then falls silent
    const Plan plan = PlanBy(step % 4 == 3 ? "ipp_reward" : "plumescout", "a");
    const PlanId id = Apply(PlanIssued{plan});
    if (plan.chosen >= 0) ++chosen;
    if (!plan.trajectory.waypoints.empty()) pose = plan.trajectory.waypoints.back().pose;
    // Every fourth plan is superseded.
    if (step % 4 != 2) Apply(ProgressReported{"a", id, kOutcomes[step % 3]});
  }
  EXPECT_GE(chosen, 6);
  Plan other = PlanBy("ipp_reward", "b");
  if (other.chosen >= 0) Apply(PlanIssued{other});
  EXPECT_LT(slim_bytes_, whole_bytes_);
}

// Both refuse what does not make sense.
TEST_F(SlimPlanTest, AChoiceThatIsNoneIsRefusedAllTheSame) {
  Apply(RobotRegistered{"a", 0.2, 1});
  Plan plan;
  plan.robot = "a";
  plan.candidates.resize(2);
  for (const int chosen : {-2, 2}) {
    plan.chosen = chosen;
    const auto event = DecodeEvent(EncodeEvent({2, PlanIssued{plan}}, PlanDetail::kForReplay));
    ASSERT_TRUE(event.ok()) << event.status();
    EXPECT_EQ(mission_->Apply(PlanIssued{plan}).status().code(),
              slim_->Apply(event->body).status().code());
    EXPECT_FALSE(slim_->Apply(event->body).ok());
  }
}

}  // namespace slim_plan_test
}  // namespace plumescout
