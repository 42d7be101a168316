// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_episode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/studies/study_figures.h"

namespace plumescout::lab {
namespace xit_episode_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr GoalKind kOccupancy = GoalKind::kOccupancyFrontier;
constexpr GoalKind kGas = GoalKind::kGasFrontier;

// Trajectories of 5 m, 10 s apart.
std::vector<MissionMoment> Moments(const std::vector<GoalKind>& kinds) {
  std::vector<MissionMoment> moments;
  for (const GoalKind kind : kinds) {
    MissionMoment moment;
    moment.time_s = 10.0 * static_cast<double>(moments.size());
    Candidate candidate;
    candidate.goal.kind = kind;
    candidate.length_m = 5.0;
    moment.plan.candidates = {candidate};
    moment.plan.chosen = 0;
    moments.push_back(moment);
  }
  return moments;
}

std::vector<std::size_t> Indices(const std::vector<ChosenMoment>& chosen) {
  std::vector<std::size_t> indices;
  for (const ChosenMoment& moment : chosen) indices.push_back(moment.index);
  return indices;
}

TEST(XitEpisode, ChoosesTheMomentsOfTheCaption) {
  const auto moments = Moments({kOccupancy, kOccupancy, kGas, kGas, kOccupancy, kGas, kOccupancy,
                                kGas, kOccupancy, kOccupancy, kGas, kGas});
  std::vector<Detour> detours(moments.size());
  detours[1] = {{}, 3.0, 0.9, 0.1};   // too early
  detours[9] = {{}, 1.05, 0.9, 0.1};  // hardly a detour
  detours[10] = {{}, 1.5, 0.6, 0.5};  // gains less
  detours[11] = {{}, 1.2, 0.8, 0.5};
  const auto chosen = ChooseMoments(moments, detours);
  EXPECT_THAT(Indices(chosen), ElementsAre(0, 2, 4, 7, 8, 11));
  EXPECT_EQ(chosen[0].kind, MomentKind::kFirstFrontier);
  EXPECT_EQ(chosen[1].kind, MomentKind::kFirstGasFrontier);
  EXPECT_EQ(chosen[2].kind, MomentKind::kAlternation);
  EXPECT_EQ(chosen[5].kind, MomentKind::kExploitation);
}

TEST(XitEpisode, ShowsWhatThereIs) {
  EXPECT_THAT(ChooseMoments({}, {}), IsEmpty());
  const auto exploring = Moments({kOccupancy, kOccupancy});
  EXPECT_THAT(Indices(ChooseMoments(exploring, std::vector<Detour>(2))), ElementsAre(0));
  const auto gas_at_last = Moments({kOccupancy, kGas});
  EXPECT_THAT(Indices(ChooseMoments(gas_at_last, std::vector<Detour>(2))), ElementsAre(0, 1));
}

TEST(XitEpisode, DrawsAMissionWithItsCurves) {
  ExperimentOptions options;
  options.quick = true;
  double last = 0.0;
  options.progress = [&](double share) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1.0);
    last = share;
  };
  const auto study = RunXitEpisode(options);
  ASSERT_TRUE(study.ok()) << study.status();
  EXPECT_GE(study->figures.panels.size(), 4u);  // (a), (b), truth and estimate at least
  EXPECT_EQ(study->figures.charts.size(), 3u);
  EXPECT_GT(last, 0.9);
  const auto& rows = study->table.rows;
  ASSERT_GE(rows.size(), 12u);  // 60 s by 5 s
  EXPECT_GT(rows.back()[1], rows.front()[1]) << "the map grew";
  EXPECT_LT(rows.back()[2], rows.back()[3]) << "it knows more of the gas than nothing";
  EXPECT_GT(FigureOf(*study, "within_2_sigma"), 0.0);
}

}  // namespace xit_episode_test
}  // namespace plumescout::lab
