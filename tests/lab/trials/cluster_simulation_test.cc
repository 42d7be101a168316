// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/cluster_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace plumescout::lab {
namespace cluster_simulation_test {

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double Max(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}
double Min(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

TEST(FailoverWaits, NobodyIsServedBeforeTheLeaseIsOver) {
  ClusterModel model;
  model.lease_s = 4.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<double> waits_s = FailoverWaits_s(model, seed);
    ASSERT_EQ(waits_s.size(), static_cast<std::size_t>(model.missions * model.robots));
    EXPECT_GE(Min(waits_s), 0.75 * model.lease_s);
    EXPECT_EQ(FailoverWaits_s(model, seed), waits_s);
  }
  EXPECT_NE(FailoverWaits_s(model, 1), FailoverWaits_s(model, 2));
}

// A second each, one after the other, at one node: the last is there after a hundred, and its
// robots ask twice a second.
TEST(FailoverWaits, AreThoseOfTheRecoveriesWhereThoseAreLong) {
  ClusterModel model;
  model.nodes = 2;
  model.missions = 100;
  model.read_s = 1.0;
  model.largest_tail = 0.0;
  const double last_s = Max(FailoverWaits_s(model, 1));
  EXPECT_GT(last_s, 100.0 + 0.75 * model.lease_s);
  EXPECT_LT(last_s, 100.0 + model.lease_s + 2.0);
  model.utilisation = 0.75;  // half a core is left
  EXPECT_NEAR(Max(FailoverWaits_s(model, 1)), last_s + 100.0, 1.0);
  model.utilisation = 0.5;
  model.nodes = 101;  // some node gets several of them, none gets many
  EXPECT_LT(Max(FailoverWaits_s(model, 1)), 10.0);
}

// Two at a time on two cores take half as long as one; on one core all are there as soon, and most
// of them later.
TEST(FailoverWaits, AreShorterWhereSeveralAreRecoveredAtATimeIfThereAreCores) {
  ClusterModel model;
  model.nodes = 2;
  model.missions = 100;
  model.read_s = 1.0;
  model.largest_tail = 0.0;
  model.recoveries = 1;
  const std::vector<double> one_s = FailoverWaits_s(model, 1);
  model.recoveries = 2;
  const std::vector<double> two_s = FailoverWaits_s(model, 1);
  EXPECT_NEAR(Max(two_s), Max(one_s), 1.0);
  EXPECT_GT(Mean(two_s), Mean(one_s) + 0.2);
  model.cores = 4.0;  // two are left
  EXPECT_NEAR(Max(FailoverWaits_s(model, 1)), Max(one_s) / 2.0, 1.0);
  model.recoveries = 1;
  EXPECT_NEAR(Max(FailoverWaits_s(model, 1)), Max(one_s), 1.0) << "one cannot use them";
}

TEST(FailoverWaits, HaveTheTimeInThemAfterWhichANodeThatHangsIsNoticed) {
  ClusterModel model;
  model.noticed_s = 3.0;  // longer than the lease
  EXPECT_GT(Min(FailoverWaits_s(model, 1)), 3.0);
  EXPECT_LT(Min(FailoverWaits_s(model, 1)), 4.0);
}

// Pollaczek and Khinchine: of half the load, half a service on average, and the service itself.
TEST(WriterWaits, AreThoseOfAQueueOfOneServer) {
  HotMission mission{.robots = 50, .events_per_s = 10.0, .event_s = 0.001, .duration_s = 2000.0};
  EXPECT_NEAR(Mean(WriterWaits_s(mission, 1)), 0.0015, 0.00003);
  EXPECT_NEAR(static_cast<double>(WriterWaits_s(mission, 1).size()), 1e6, 5e3);
}

TEST(WriterWaits, GrowWithoutBoundBeyondWhatTheWriterCanDo) {
  HotMission mission{.robots = 200, .events_per_s = 10.0, .event_s = 0.001, .duration_s = 10.0};
  EXPECT_NEAR(Max(WriterWaits_s(mission, 1)), 10.0, 0.5);  // half is done when it ends
  mission.duration_s = 20.0;
  EXPECT_NEAR(Max(WriterWaits_s(mission, 1)), 20.0, 1.0);
}

}  // namespace cluster_simulation_test
}  // namespace plumescout::lab
