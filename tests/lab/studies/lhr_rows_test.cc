// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/lhr_rows.h"

#include <gtest/gtest.h>

#include "lab/worlds/lhr_scene.h"

namespace plumescout::lab {
namespace lhr_rows_test {

TEST(LhrRows, SayWhatThePaperStatesAndWhatItDoesNot) {
  const GridGeometry geometry{0.0, 0.0, 1.0, kLhrNodes, kLhrNodes};
  const LhrUnstated unstated = {.prior_precision_per_ppm2 = 0.5, .beta = 7.0};
  for (const LhrRow& row : kLhrRows) {
    const auto made = MakeLhrStudyRow(row, unstated, geometry);
    ASSERT_TRUE(made.ok()) << made.status();
    EXPECT_EQ(made->name, row.name);
    EXPECT_EQ(made->mission.gas.prior_precision_per_ppm2, 0.5);
    const PlanningOptions& planning = made->mission.planning;
    EXPECT_EQ(planning.beta, 7.0);
    EXPECT_EQ(planning.sites.reward, row.reward);
    EXPECT_EQ(planning.sites.survey, row.survey);
    EXPECT_EQ(planning.sites.update_period_s, 50.0);  // [LHR] section IV-A
    EXPECT_TRUE(Validate(made->mission).ok());
  }
}

TEST(LhrRows, DriveFromEachCornerOfEachWorld) {
  ExperimentOptions options;
  options.seed = 5;
  const Scene world = MakeLhrScene(LhrTable1Sources());
  const SamplingPlan plan = MakeLhrDrives(options, {world, world}, LhrStarts().size());
  ASSERT_EQ(plan.cases.size(), 8U);
  EXPECT_EQ(plan.cases[4].world, 1U);
  EXPECT_EQ(plan.cases[4].start.x_m, LhrStarts()[0].x_m);
  for (std::size_t i = 0; i < plan.cases.size(); ++i) EXPECT_EQ(plan.cases[i].seed, 5 + i);
}

TEST(LhrRows, HaveConvergedFromWhenOnTheErrorStaysInTheBand) {
  SamplingDrive drive;
  drive.elapsed_s = 240.0;
  for (const double rmse_ppm : {2.0, 1.003, 1.0, 1.001, 1.0}) {
    drive.errors.push_back(
        {.time_s = 60.0 * static_cast<double>(drive.errors.size()), .rmse_ppm = rmse_ppm});
  }
  EXPECT_DOUBLE_EQ(LhrConvergence_min(drive, 0.01), 1.0);
  EXPECT_DOUBLE_EQ(LhrConvergence_min(drive), 2.0);  // 0.2 %
}

}  // namespace lhr_rows_test
}  // namespace plumescout::lab
