// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/experiments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>

namespace plumescout::lab {
namespace experiments_test {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

TEST(Experiments, ThoseOfThePapersAreThere) {
  EXPECT_THAT(ExperimentNames(), IsSupersetOf({"xit_table3", "xit_episode", "xit_trial", "xit_fig3",
                                               "xit_fig4", "xit_fig5", "mit_table1"}));
}

TEST(Experiments, AllAreThoseOfThePapersAndOfOneRobot) {
  EXPECT_THAT(ExperimentsOfAll(), IsSupersetOf({"xit_table3", "mit_table1", "lhr_table2",
                                                "ipp_table1", "own_strategy"}));
  constexpr std::size_t kByNameAlone = 3;
  for (const char* name : {"lhr_calibration", "team_rivals", "team_study"}) {
    EXPECT_THAT(ExperimentsOfAll(), Not(Contains(name)));
  }
  EXPECT_THAT(ExperimentNames(), IsSupersetOf(ExperimentsOfAll()));
  EXPECT_EQ(ExperimentNames().size(), ExperimentsOfAll().size() + kByNameAlone);
}

// The others, which take longer, have tests of their own.
TEST(Experiments, RunByTheirNameAndRepeatFromTheirSeed) {
  ExperimentOptions options;
  options.quick = true;
  for (const char* name : {"xit_fig3", "xit_fig4", "xit_fig5"}) {
    const auto study = RunExperiment(name, options);
    ASSERT_TRUE(study.ok()) << study.status();
    EXPECT_FALSE(study->table.rows.empty()) << name;
    EXPECT_EQ(RunExperiment(name, options)->figures.key_numbers, study->figures.key_numbers)
        << name;
    options.seed = 2;
    EXPECT_NE(RunExperiment(name, options)->figures.key_numbers, study->figures.key_numbers)
        << name;
    options.seed = 1;
  }
}

TEST(Experiments, AnUnknownNameIsRefusedWithThoseThatThereAre) {
  const absl::Status status = RunExperiment("xit_fig99", {}).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(status.message(), HasSubstr("xit_fig4"));
}

TEST(Experiments, OptionsOutOfRangeAreRefusedByName) {
  ExperimentOptions options;
  options.trials = 0;
  EXPECT_THAT(RunExperiment("xit_fig3", options).status().message(), HasSubstr("trials = 0"));
  options.trials.reset();
  options.jobs = -1;
  EXPECT_THAT(RunExperiment("xit_fig3", options).status().message(), HasSubstr("jobs = -1"));
}

}  // namespace experiments_test
}  // namespace plumescout::lab
