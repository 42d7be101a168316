// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The same mission twice: over a real connection, and within one process.
#include <gtest/gtest.h>

#include "lab/local/local_planner_client.h"
#include "tests/e2e/trial.h"

namespace plumescout::lab {
namespace {

Trial RunOverGrpc() {
  const auto server = StartServer();
  const auto planner = ClientOf(*server);
  const absl::StatusOr<Trial> trial = RunTrial(*planner, TrialOptions());
  EXPECT_TRUE(trial.ok()) << trial.status();
  return trial.ok() ? *trial : Trial{};
}

Trial RunInProcess() {
  LocalPlannerClient local;
  const auto planner = WithTap(local, AsOnTheWire);
  const absl::StatusOr<Trial> trial = RunTrial(*planner, TrialOptions());
  EXPECT_TRUE(trial.ok()) << trial.status();
  return trial.ok() ? *trial : Trial{};
}

const Trial& TrialOverGrpc() {
  static const Trial trial = RunOverGrpc();
  return trial;
}

void ExpectSame(const Trial& a, const Trial& b) {
  ASSERT_EQ(a.episode.path.size(), b.episode.path.size());
  for (std::size_t i = 0; i < a.episode.path.size(); ++i) {
    ASSERT_EQ(a.episode.path[i].time_s, b.episode.path[i].time_s) << i;
    ASSERT_EQ(a.episode.path[i].pose, b.episode.path[i].pose) << i;
  }
  EXPECT_TRUE(ComparablePlans(a.episode) == ComparablePlans(b.episode));
  EXPECT_TRUE(SameMap(a.map, b.map));
}

TEST(RepeatabilityTest, AMissionIsWorthComparing) {
  const Trial& trial = TrialOverGrpc();

  EXPECT_EQ(trial.episode.readings_applied, trial.episode.readings_sent);
  EXPECT_GT(trial.episode.readings_sent, 400);  // 12 a second
  EXPECT_GE(trial.episode.plans.size(), 3U);
  EXPECT_GT(trial.episode.distance_m, 5.0);
  EXPECT_EQ(trial.episode.collisions, 0);
  EXPECT_GT(trial.episode.samples.back().metrics.completeness,
            trial.episode.samples.front().metrics.completeness);
  EXPECT_GT(trial.map.gas_counters.in_posterior, 0);
}

TEST(RepeatabilityTest, OverGrpcTheSameMissionComesToTheSameBytes) {
  ExpectSame(TrialOverGrpc(), RunOverGrpc());
}

TEST(RepeatabilityTest, WithinOneProcessAMissionComesToTheBytesOfTheWire) {
  ExpectSame(TrialOverGrpc(), RunInProcess());
}

}  // namespace
}  // namespace plumescout::lab
