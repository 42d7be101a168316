// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/experiments/experiments.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace {

TEST(Experiments, EachRunsByItsNameAndRepeatsFromItsSeed) {
  ExperimentOptions options;
  options.quick = true;
  for (const std::string& name : ExperimentNames()) {
    const auto study = RunExperiment(name, options);
    ASSERT_TRUE(study.ok()) << study.status();
    EXPECT_FALSE(study->table.rows.empty()) << name;
    EXPECT_EQ(RunExperiment(name, options)->figures.key_numbers, study->figures.key_numbers)
        << name;
    if (name == "wind_validation") continue;  // draws nothing
    options.seed = 2;
    EXPECT_NE(RunExperiment(name, options)->figures.key_numbers, study->figures.key_numbers)
        << name;
    options.seed = 1;
  }
}

TEST(Experiments, AnUnknownNameIsRefusedWithThoseThatThereAre) {
  const absl::Status status = RunExperiment("xit_fig99", {}).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_NE(status.message().find("xit_fig4"), std::string::npos);
}

}  // namespace
}  // namespace plumescout::lab
