// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/map_judge.h"

#include <gtest/gtest.h>

#include "lab/local/local_planner_client.h"
#include "tests/support/small_scene.h"

namespace plumescout::lab {
namespace map_judge_test {

class MapJudgeTest : public ::testing::Test {
 protected:
  MapJudge Judge(double period_s) {
    return MapJudge(planner_, "m", period_s, MapEvaluator(MakeSmallScene(), 0.3),
                    [this](const MetricSample&, const MapSnapshot&) { ++told_; });
  }

  LocalPlannerClient planner_;
  int told_ = 0;
};

TEST_F(MapJudgeTest, TakesOneSampleAPeriodWhoeverAsks) {
  ASSERT_TRUE(planner_.CreateMission("m", MissionOptions{}).ok());
  MapJudge judge = Judge(5.0);
  for (const double time_s : {0.0, 0.0, 0.1, 4.9, 5.0, 5.0, 12.0, 12.0}) {
    judge.TakeIfDue(time_s, {});
  }
  EXPECT_TRUE(judge.status().ok()) << judge.status();
  ASSERT_EQ(judge.samples().size(), 3u);
  EXPECT_EQ(judge.samples()[0].time_s, 0.0);
  EXPECT_EQ(judge.samples()[1].time_s, 5.0);
  EXPECT_EQ(judge.samples()[2].time_s, 12.0);
  EXPECT_EQ(told_, 3);
}

}  // namespace map_judge_test
}  // namespace plumescout::lab
