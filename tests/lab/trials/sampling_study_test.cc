// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/sampling_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/lab/trials/small_sampling.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace sampling_study_test {

using ::testing::HasSubstr;

constexpr int kSites = 29;

TEST(SamplingStudy, DrivesEveryRowThroughEveryCase) {
  const TempFolder folder;
  const auto drives = RunSamplingStudy(SmallSampling(folder.File("drives")));
  ASSERT_TRUE(drives.ok()) << drives.status();
  ASSERT_EQ(drives->size(), 2u);
  for (const std::vector<SamplingDrive>& row : *drives) {
    ASSERT_EQ(row.size(), 2u);
    for (const SamplingDrive& drive : row) {
      EXPECT_EQ(drive.end, SamplingEnd::kMissionComplete);
      EXPECT_EQ(drive.samples, kSites);
      EXPECT_LT(drive.errors.back().rmse_ppm, 0.5 * drive.errors.front().rmse_ppm);
      EXPECT_EQ(drive.calibration.estimated_cells, 5) << "those with gas";
      EXPECT_GT(drive.calibration.rms_z, 0.0);
    }
  }
  EXPECT_LT((*drives)[0][0].driven_m, (*drives)[1][0].driven_m) << "a sweep is the shorter way";
}

TEST(SamplingStudy, DoesNotDependOnTheNumberOfJobs) {
  const TempFolder folder;
  const auto one = RunSamplingStudy(SmallSampling(folder.File("one")));
  SamplingPlan plan = SmallSampling(folder.File("three"));
  plan.jobs = 3;
  const auto three = RunSamplingStudy(plan);
  ASSERT_TRUE(one.ok() && three.ok());
  EXPECT_EQ(*one, *three);
  EXPECT_EQ(RunSamplingStudy(plan).value(), *three) << "read again";
}

TEST(SamplingStudy, GoesOnFromWhatItFindsAndTellsSettingsApart) {
  const TempFolder folder;
  SamplingPlan plan = SmallSampling(folder.File("drives"));
  const auto first = RunSamplingStudy(plan);
  ASSERT_TRUE(first.ok());
  // A record that says something else shows whether it was read or made anew.
  const std::string file = plan.folder + "/sweep-one.json";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string changed = text.str();
  const std::string samples = "\"samples\":29";
  ASSERT_THAT(changed, HasSubstr(samples));
  changed.replace(changed.find(samples), samples.size(), "\"samples\":28");
  std::ofstream(file) << changed;
  EXPECT_EQ(RunSamplingStudy(plan).value()[0][0].samples, 28);
  plan.noise.sigma_ppm = 0.5;
  EXPECT_EQ(RunSamplingStudy(plan).value()[0][0].samples, kSites);
}

// Drives sample all of the yard's sites, the source's among them.
TEST(SamplingStudy, TellsWhenTheSourceWasSampled) {
  const TempFolder folder;
  const auto drives = RunSamplingStudy(SmallSampling(folder.File("drives")));
  ASSERT_TRUE(drives.ok());
  for (const std::vector<SamplingDrive>& row : *drives) {
    for (const SamplingDrive& drive : row) {
      ASSERT_TRUE(drive.source_s.has_value());
      EXPECT_GT(*drive.source_s, 0.0);
      EXPECT_LE(*drive.source_s, drive.elapsed_s);
    }
  }
  SamplingPlan elsewhere = SmallSampling(folder.File("elsewhere"));
  elsewhere.worlds[0].sources[0].x_m = 3.5;  // in the wall, where nothing is sampled
  const auto none = RunSamplingStudy(elsewhere);
  ASSERT_TRUE(none.ok());
  EXPECT_EQ((*none)[0][0].source_s, std::nullopt);
  EXPECT_EQ(RunSamplingStudy(elsewhere).value(), *none) << "read again";
}

TEST(SamplingStudy, FinalMapsAreThoseOfRows) {
  SamplingPlan plan;
  plan.rows = {{"a", {}}, {"b", {}}};
  std::vector<std::vector<SamplingDrive>> drives(2, std::vector<SamplingDrive>(3));
  drives[1][2].calibration.rms_z = 1.5;
  const std::vector<RowMaps> rows = FinalMaps(plan, drives);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].name, "b");
  ASSERT_EQ(rows[1].maps.size(), 3u);
  EXPECT_EQ(rows[1].maps[2].rms_z, 1.5);
}

TEST(SamplingStudy, MeansAreThoseOfWorlds) {
  SamplingPlan plan;
  plan.worlds.resize(3);
  plan.cases = {{"a", 0, {}, 1}, {"b", 2, {}, 1}, {"c", 0, {}, 1}};
  std::vector<SamplingDrive> row(3);
  row[0].driven_m = 1.0;
  row[1].driven_m = 7.0;
  row[2].driven_m = 2.0;
  const std::vector<double> means =
      MeansByWorld(plan, row, [](const SamplingDrive& drive) { return drive.driven_m; });
  EXPECT_EQ(means, (std::vector<double>{1.5, 7.0}));  // no drive goes through the second
  EXPECT_EQ(ByWorld(plan, row)[0], (std::vector<SamplingDrive>{row[0], row[2]}));
  EXPECT_TRUE(ByWorld(plan, row)[1].empty());
}

TEST(SamplingStudy, NamesTheDriveThatFailed) {
  const TempFolder folder;
  SamplingPlan plan = SmallSampling(folder.File("drives"));
  plan.rows[1].mission.planning.sites.region->max.x_m = 6.5;
  const absl::Status status = RunSamplingStudy(plan).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr("random_sampling-one"));
  EXPECT_THAT(std::string(status.message()), HasSubstr("region"));
}

}  // namespace sampling_study_test
}  // namespace plumescout::lab
