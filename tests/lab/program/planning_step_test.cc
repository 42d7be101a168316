// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/planning_step.h"

#include <gtest/gtest.h>

#include <string>

#include "core/plan/strategy.h"
#include "lab/local/local_planner_client.h"
#include "lab/program/recording.h"
#include "tests/support/room_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace planning_step_test {

constexpr char kRobot[] = "scout";

// A mission whose robot has seen most of a room and smelled something.
class PlanningStepTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Apply(RobotRegistered{.robot = kRobot, .radius_m = 0.2, .lease_token = 1});
    const std::vector<Observation> run = support::RoomRun();
    for (std::size_t i = 0; i < 80; ++i) Apply(ObservationReceived{kRobot, run[i]});
  }
  void Apply(const EventBody& body) {
    const auto applied = mission_.Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
  }

  Mission mission_{MissionOptions{}};
};

TEST_F(PlanningStepTest, MakesThePlanThatAStrategyMakes) {
  const auto step = TakePlanningStep(mission_, {});
  ASSERT_TRUE(step.ok()) << step.status();
  ASSERT_FALSE(step->plan.candidates.empty());
  const auto strategy = MakeStrategy(mission_.options().planning);
  ASSERT_TRUE(strategy.ok()) << strategy.status();
  PlanRequest request;
  request.robot = kRobot;
  const auto plan = (*strategy)->Plan(*mission_.Snapshot(), request, NeverStop());
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(step->plan.seed, plan->seed);
  EXPECT_EQ(step->plan.chosen, plan->chosen);
  EXPECT_EQ(step->plan.trajectory, plan->trajectory);
}

TEST(PlanningStepOfARecording, AtTheRevisionOfAnIssuedPlanIsThatPlan) {
  const TempFolder folder;
  const std::string path = folder.File("mission.events");
  auto recorder = Recorder::Create(path, MissionOptions{});
  ASSERT_TRUE(recorder.ok()) << recorder.status();
  LocalOptions local;
  local.on_event = [&](const Event& event) { recorder->Record(event); };
  LocalPlannerClient planner(local);
  ASSERT_TRUE(planner.CreateMission("house", MissionOptions{}).ok());
  const auto session = planner.RegisterRobot("house", kRobot, 0.2, false);
  ASSERT_TRUE(session.ok()) << session.status();
  const auto stream = planner.OpenObservationStream(*session);
  ASSERT_TRUE(stream.ok()) << stream.status();
  const std::vector<Observation> run = support::RoomRun();
  ASSERT_TRUE((*stream)->Write({run.begin(), run.begin() + 80}).ok());
  client::PlanQuery query;
  query.request.robot = kRobot;
  query.lease_token = session->lease_token;
  query.budget = absl::InfiniteDuration();
  query.timeout = absl::InfiniteDuration();
  const auto issued = planner.NextBestTrajectory("house", query);
  ASSERT_TRUE(issued.ok()) << issued.status();
  ASSERT_TRUE((*stream)->Write({run.begin() + 80, run.begin() + 120}).ok());

  ASSERT_TRUE(recorder->status().ok()) << recorder->status();
  auto recording = Recording::Open(path);
  ASSERT_TRUE(recording.ok()) << recording.status();
  const auto mission = Replay(*recording, issued->belief_revision);
  ASSERT_TRUE(mission.ok()) << mission.status();
  const auto step = TakePlanningStep(**mission, {});
  ASSERT_TRUE(step.ok()) << step.status();
  EXPECT_GE(issued->chosen, 0);
  EXPECT_EQ(step->plan.chosen, issued->chosen);
  EXPECT_EQ(step->plan.trajectory, issued->trajectory);
  EXPECT_EQ(step->plan.explanation, issued->explanation);
  EXPECT_EQ(step->plan.rejected, issued->rejected);
}

TEST_F(PlanningStepTest, ShowsTreeFieldAndExpectedInformation) {
  const auto step = TakePlanningStep(mission_, {});
  ASSERT_TRUE(step.ok()) << step.status();
  EXPECT_EQ(step->tree.size() + 1, static_cast<std::size_t>(step->plan.effort.vertices));
  EXPECT_EQ(step->information.value.geometry(), step->belief->geometry());
  for (const Candidate& candidate : step->plan.candidates) {
    ASSERT_TRUE(candidate.expected_information_nats.has_value());
    EXPECT_GT(*candidate.expected_information_nats, 0.0);
  }
}

TEST_F(PlanningStepTest, BringsThePosteriorUpToDateFirst) {
  ASSERT_TRUE(mission_.posterior_stale());
  const auto step = TakePlanningStep(mission_, {});
  ASSERT_TRUE(step.ok()) << step.status();
  EXPECT_FALSE(mission_.posterior_stale());
  EXPECT_EQ(step->belief->posterior_time_ns, mission_.sample_time_ns());
}

TEST_F(PlanningStepTest, TakesAnotherStrategyAndSeed) {
  const auto rival = TakePlanningStep(mission_, {kRobot, "rrt_star_frontier"});
  ASSERT_TRUE(rival.ok()) << rival.status();
  EXPECT_EQ(rival->plan.strategy, "rrt_star_frontier");
  EXPECT_TRUE(rival->tree.empty());
  const auto reseeded = TakePlanningStep(mission_, {kRobot, "", 9});
  ASSERT_TRUE(reseeded.ok()) << reseeded.status();
  EXPECT_EQ(reseeded->plan.seed, 9u);
}

TEST_F(PlanningStepTest, SaysWhatIsNotThere) {
  EXPECT_TRUE(absl::IsNotFound(TakePlanningStep(mission_, {"nobody", ""}).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(TakePlanningStep(mission_, {kRobot, "guess"}).status()));
  Mission empty{MissionOptions{}};
  EXPECT_TRUE(absl::IsNotFound(TakePlanningStep(empty, {}).status()));
}

TEST_F(PlanningStepTest, OfAStrategyThatSamplesSitesGrowsNoTree) {
  PlanningStepOptions options;
  options.strategy = "ipp_reward";
  const auto step = TakePlanningStep(mission_, options);
  ASSERT_TRUE(step.ok()) << step.status();
  EXPECT_EQ(step->plan.phase, MissionPhase::kSampling);
  ASSERT_FALSE(step->plan.candidates.empty());
  EXPECT_EQ(step->plan.candidates[0].goal.kind, GoalKind::kSite);
  EXPECT_TRUE(step->tree.empty());
}

}  // namespace planning_step_test
}  // namespace plumescout::lab
