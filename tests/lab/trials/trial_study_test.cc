// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/trial_study.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/plan/strategy.h"
#include "lab/formats/scene_folder.h"
#include "tests/lab/sim/small_scene.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace trial_study_test {

TrialPlan SmallPlan(const TempFolder& folder) {
  TrialPlan plan;
  for (const char* strategy : {"xit_gff", "rrt_star_frontier"}) {
    StudyRow row{strategy, {}};
    row.mission.planning.strategy = strategy;
    EXPECT_TRUE(ApplyStrategyRow(row.mission.planning).ok());
    plan.rows.push_back(row);
  }
  plan.scenes = {folder.File("scene")};
  plan.trials = 2;
  plan.duration_s = 8.0;
  plan.folder = folder.File("trials");
  EXPECT_TRUE(WriteScene(SmallScene(), plan.scenes.front()).ok());
  return plan;
}

double FinalRmse(const TrialRecord& record) { return record.curve.back().metrics.rmse_ppm; }

TEST(TrialStudy, MakesRowsWithThePapersGoalsOrAll) {
  const auto paper = MakeStudyRow("a", "xit_gff", true);
  const auto ours = MakeStudyRow("b", "xit_gff", false);
  ASSERT_TRUE(paper.ok() && ours.ok());
  EXPECT_TRUE(paper->mission.planning.draw_goals);
  EXPECT_FALSE(paper->mission.planning.fallback_to_unobserved);
  EXPECT_EQ(paper->mission.planning.max_connection_radius_m, 0.0);
  EXPECT_FALSE(ours->mission.planning.draw_goals);
  EXPECT_TRUE(ours->mission.planning.fallback_to_unobserved);
  EXPECT_EQ(ours->mission.planning.max_connection_radius_m, 5.0);
  EXPECT_EQ(MakeStudyRow("c", "xit_none", true).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(TrialStudy, MakesPublishedRowsToTheLetter) {
  const auto row = MakePublishedRow("a", "xit_gff");
  ASSERT_TRUE(row.ok());
  const PlanningOptions& planning = row->mission.planning;
  EXPECT_TRUE(planning.draw_goals);
  EXPECT_EQ(planning.sample_count, 300);
  EXPECT_EQ(planning.sampling, SamplingKind::kIid);
  EXPECT_TRUE(planning.raw_variance);
  EXPECT_EQ(planning.max_connection_radius_m, 0.0);
  EXPECT_FALSE(planning.goal_vertices);
  EXPECT_FALSE(planning.grid_guard);
  EXPECT_FALSE(planning.straighten);
  EXPECT_EQ(row->mission.frontier.wgfd_scope, WgfdScope::kLocal);
  EXPECT_FALSE(row->robot.corrects_gas_lag);
  EXPECT_TRUE(absl::IsInvalidArgument(MakePublishedRow("b", "xit_none").status()));
}

TEST(TrialStudy, DoesNotDependOnTheNumberOfJobs) {
  const TempFolder folder;
  TrialPlan plan = SmallPlan(folder);
  const auto one = RunTrials(plan);
  plan.folder = folder.File("other");
  plan.jobs = 3;
  const auto three = RunTrials(plan);
  ASSERT_TRUE(one.ok() && three.ok());
  ASSERT_EQ(one->size(), 1u);
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t trial = 0; trial < 2; ++trial) {
      EXPECT_EQ(FinalRmse((*one)[0][row][trial]), FinalRmse((*three)[0][row][trial]));
    }
  }
  EXPECT_NE(FinalRmse((*one)[0][0][0]), FinalRmse((*one)[0][0][1]));
}

TEST(TrialStudy, GoesOnFromWhatItFinds) {
  const TempFolder folder;
  TrialPlan plan = SmallPlan(folder);
  plan.trials = 1;
  const auto first = RunTrials(plan);
  ASSERT_TRUE(first.ok());
  // A record that says something else shows whether it was read or made anew.
  const std::string file = plan.folder + "/scene-xit_gff-1.json";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string changed = text.str();
  const std::string plans = "\"plans\":";
  changed.replace(changed.find(plans), plans.size() + 1, plans + "9");
  std::ofstream(file) << changed;
  plan.trials = 2;
  const auto second = RunTrials(plan);
  ASSERT_TRUE(second.ok());
  EXPECT_GE((*second)[0][0][0].plans, 9);
  EXPECT_EQ(FinalRmse((*second)[0][0][0]), FinalRmse((*first)[0][0][0]));
  EXPECT_GT((*second)[0][0][1].plans, 0);
}

TEST(TrialStudy, NamesAFolderThatIsNoScene) {
  const TempFolder folder;
  TrialPlan plan = SmallPlan(folder);
  plan.scenes = {folder.File("nothing")};
  const absl::Status status = RunTrials(plan).status();
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.message().find("nothing"), std::string::npos);
}

TEST(TrialStudy, ScenesAreNamedByTheirFolder) {
  EXPECT_EQ(SceneName("a/b/hall"), "hall");
  EXPECT_EQ(SceneName("a/b/hall/"), "hall");
}

TEST(TrialStudy, KnowsTheMapBeforehandIfTheRowSaysSo) {
  const TempFolder folder;
  TrialPlan plan = SmallPlan(folder);
  plan.trials = 1;
  plan.rows = {plan.rows[0], plan.rows[0]};
  plan.rows[1].name = "known";
  plan.rows[1].knows_map = true;
  const auto records = RunTrials(plan);
  ASSERT_TRUE(records.ok()) << records.status();
  EXPECT_LT((*records)[0][0][0].curve.front().metrics.completeness, 0.99);
  EXPECT_GT((*records)[0][1][0].curve.front().metrics.completeness, 0.99);
}

}  // namespace trial_study_test
}  // namespace plumescout::lab
