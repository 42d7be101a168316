// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/mit_runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace mit_runs_test {

const MitScene& Scene() {
  static const MitScene scene = *BuildMitScene(MitTableScene());
  return scene;
}

TEST(MitRuns, ThePapersSharesAddUpToAllRuns) {
  for (const MitRival& rival : MitRivals(Scene())) {
    const auto& shares = rival.paper_shares_percent;
    if (std::isnan(shares[0])) continue;
    EXPECT_NEAR(shares[0] + shares[1] + shares[2], 100.0, 1e-9) << rival.name;
  }
}

TEST(MitRuns, EveryPlannerLeadsFromTheStartToNearItsGoals) {
  for (const MitRival& rival : MitRivals(Scene())) {
    for (const MitRun& run : RunMitRival(rival, Scene(), 3, 1, nullptr)) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (run.paths[i].empty()) continue;
        EXPECT_EQ(run.paths[i].front(), Scene().start);
        EXPECT_LT(Distance_m(run.paths[i].back(), Scene().goals[i].position), 2.0) << rival.name;
        EXPECT_GE(run.length_m[i], Distance_m(Scene().start, run.paths[i].back()) - 1e-9);
        EXPECT_GE(run.psi[i], 0.0);
        EXPECT_LE(run.psi[i], run.psi[static_cast<std::size_t>(run.best)]);
      }
    }
  }
}

// What "a similar total number of sampling points" is: the trees' mean within a fifth of MIT's N.
TEST(MitRuns, AllDrawAboutAsManySamples) {
  for (const MitRival& rival : MitRivals(Scene())) {
    const MitSummary summary = Summarise(RunMitRival(rival, Scene(), 60, 1, nullptr));
    EXPECT_NEAR(summary.samples, kMitSamples, 0.2 * kMitSamples) << rival.name;
  }
}

TEST(MitRuns, RepeatFromTheirSeed) {
  for (const MitRival& rival : MitRivals(Scene())) {
    const auto once = RunMitRival(rival, Scene(), 2, 7, nullptr);
    const auto again = RunMitRival(rival, Scene(), 2, 7, nullptr);
    EXPECT_EQ(once[1].paths, again[1].paths) << rival.name;
    EXPECT_NE(once[0].paths, once[1].paths) << rival.name;
    EXPECT_NE(RunMitRival(rival, Scene(), 1, 8, nullptr)[0].paths, once[0].paths) << rival.name;
  }
}

// Even samples are a share of 1 of them, samples of I-hat none; Eq. (2) lies between.
TEST(MitRuns, AnswersDifferByWhatSamplesAreDrawnFrom) {
  const std::vector<MitRival> rivals = MitRivals(Scene());
  ASSERT_EQ(rivals.size(), 5u);
  EXPECT_GT(Scene().ucb_uniform_share, 0.0);
  EXPECT_LT(Scene().ucb_uniform_share, 1.0);
  const auto paths = [&](std::size_t i) {
    return RunMitRival(rivals[i], Scene(), 1, 1, nullptr)[0].paths;
  };
  EXPECT_NE(paths(0), paths(3));
  EXPECT_NE(paths(0), paths(4));
}

MitRun MakeRun(std::array<double, 3> psi, int best) {
  MitRun run;
  for (std::size_t i = 0; i < 3; ++i) {
    run.psi[i] = psi[i];
    run.length_m[i] = 2.0;
    if (!std::isnan(psi[i])) run.paths[i] = {{0.0, 0.0}, {2.0, 0.0}};
  }
  run.best = best;
  run.samples = 10;
  return run;
}

TEST(MitRuns, SummariesCountWhatWasFound) {
  const MitSummary summary = Summarise(
      {MakeRun({0.2, 0.5, NAN}, 1), MakeRun({0.4, 0.1, NAN}, 0), MakeRun({NAN, NAN, NAN}, -1)});
  EXPECT_EQ(summary.best, (std::array<int, 3>{1, 1, 0}));
  EXPECT_DOUBLE_EQ(summary.share(0), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(summary.psi[0], 0.3);
  EXPECT_TRUE(std::isnan(summary.psi[2]));
  EXPECT_EQ(summary.found, (std::array<int, 3>{2, 2, 0}));
  EXPECT_DOUBLE_EQ(summary.chosen_psi, 0.45);
  EXPECT_DOUBLE_EQ(summary.samples, 10.0);
}

TEST(MitRuns, TheMostTypicalPathIsTheOneInTheMiddle) {
  const std::vector<Point2> low = {{0.0, 0.0}, {5.0, 0.0}};
  const std::vector<Point2> middle = {{0.0, 1.0}, {1.0, 1.0}, {5.0, 1.0}};
  const std::vector<Point2> high = {{0.0, 2.0}, {5.0, 2.0}};
  const std::vector<Point2> none;
  EXPECT_EQ(MostTypical({&low, &none, &middle, &high}), 2);
  EXPECT_EQ(MostTypical({&none, &none}), -1);
  EXPECT_EQ(MostTypical({}), -1);
}

TEST(MitRuns, APathOfNoLengthCanBeTypical) {
  const std::vector<Point2> point = {{1.0, 1.0}, {1.0, 1.0}};
  EXPECT_EQ(MostTypical({&point}), 0);
}

}  // namespace mit_runs_test
}  // namespace plumescout::lab
