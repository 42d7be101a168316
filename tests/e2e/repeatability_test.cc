// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The same mission twice: over a real connection, and within one process.
#include <gtest/gtest.h>

#include "lab/local/local_planner_client.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace repeatability_test {

HallRun RunOverGrpc() {
  const auto server = StartServer();
  const auto planner = ClientOf(*server);
  const absl::StatusOr<HallRun> run = RunInHall(*planner, HallOptions());
  EXPECT_TRUE(run.ok()) << run.status();
  return run.ok() ? *run : HallRun{};
}

HallRun RunInProcess() {
  LocalPlannerClient local;
  const auto planner = WithTap(local, AsOnTheWire);
  const absl::StatusOr<HallRun> run = RunInHall(*planner, HallOptions());
  EXPECT_TRUE(run.ok()) << run.status();
  return run.ok() ? *run : HallRun{};
}

const HallRun& HallRunOverGrpc() {
  static const HallRun run = RunOverGrpc();
  return run;
}

void ExpectSame(const HallRun& a, const HallRun& b) {
  ASSERT_EQ(a.episode.path.size(), b.episode.path.size());
  for (std::size_t i = 0; i < a.episode.path.size(); ++i) {
    ASSERT_EQ(a.episode.path[i].time_s, b.episode.path[i].time_s) << i;
    ASSERT_EQ(a.episode.path[i].pose, b.episode.path[i].pose) << i;
  }
  EXPECT_TRUE(ComparablePlans(a.episode) == ComparablePlans(b.episode));
  EXPECT_TRUE(SameMap(a.map, b.map));
}

TEST(RepeatabilityTest, AMissionIsWorthComparing) {
  const HallRun& run = HallRunOverGrpc();

  EXPECT_EQ(run.episode.readings_applied, run.episode.readings_sent);
  EXPECT_GT(run.episode.readings_sent, 400);  // 12 a second
  EXPECT_GE(run.episode.plans.size(), 3U);
  EXPECT_GT(run.episode.distance_m, 5.0);
  EXPECT_EQ(run.episode.collisions, 0);
  EXPECT_GT(run.episode.samples.back().metrics.completeness,
            run.episode.samples.front().metrics.completeness);
  EXPECT_GT(run.map.gas_counters.in_posterior, 0);
}

TEST(RepeatabilityTest, OverGrpcTheSameMissionComesToTheSameBytes) {
  ExpectSame(HallRunOverGrpc(), RunOverGrpc());
}

TEST(RepeatabilityTest, WithinOneProcessAMissionComesToTheBytesOfTheWire) {
  ExpectSame(HallRunOverGrpc(), RunInProcess());
}

}  // namespace repeatability_test
}  // namespace plumescout::lab
