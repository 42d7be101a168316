// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/flow_runs.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace flow_runs_test {

TEST(FlowRunsTest, RunsEveryFlowFromCoarseToFineAndTellsHowFarItIs) {
  ExperimentOptions options;
  options.quick = true;
  double last = 0.0;
  options.progress = [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  const auto runs = RunPublishedFlows(options);
  ASSERT_TRUE(runs.ok()) << runs.status();
  EXPECT_DOUBLE_EQ(last, 1.0);
  ASSERT_EQ(runs->cavities.size(), kGhiaCavities.size());
  for (const CavityStudy& cavity : runs->cavities) {
    ASSERT_EQ(cavity.runs.size(), 3u);
    EXPECT_EQ(cavity.runs[2].cells, 2 * cavity.runs[1].cells);
    EXPECT_LT(cavity.runs[2].u_rms, cavity.runs[1].u_rms);
    EXPECT_LT(cavity.runs[2].v_rms, cavity.runs[1].v_rms);
  }
  EXPECT_EQ(runs->channels.size(), 3u);
  EXPECT_EQ(runs->steps.size(), 2u * kReattachments.size());
}

}  // namespace flow_runs_test
}  // namespace plumescout::lab
