// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/plan_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace plan_stream_test {

using ::testing::SizeIs;

constexpr int kScans = 4;

class PlanStreamTest : public ServiceTest {
 protected:
  void Start(ScriptedStrategy::AnytimeScript script) { Start({}, AnytimeHooks(std::move(script))); }
  // A server with a robot that has seen one corner of a room.
  void Start(ServerConfig config, RegistryHooks hooks = {}) {
    StartServer(config, std::move(hooks));
    lease_ = Lease();
    constexpr double kSide_m = 30.0;
    const Pose2 pose{2.0, 1.5, 0.0};
    v1::ObservationBatch batch;
    for (std::int64_t k = 1; k <= kScans; ++k) {
      *batch.add_observations() =
          ToProto(Observation{k, 0, pose, support::ScanInBox(pose, kSide_m, kSide_m)});
    }
    ASSERT_TRUE(Ingest(kRobot, lease_, batch).ok());
  }
  v1::StreamNextBestTrajectoryRequest Order() const {
    v1::StreamNextBestTrajectoryRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_);
    request.mutable_planning_budget()->set_seconds(kAmpleBudget_s);
    return request;
  }

  std::int64_t lease_ = 0;
};

TEST_F(PlanStreamTest, PlansOnTheWayHaveNoNameAndTheLastIsCommitted) {
  absl::Notification read;
  Start([&](const Belief& belief, const PlanRequest& request, const StopFn&,
            const PlanListener& improved) {
    improved(PlanTo(belief, request.robot, 3.0));
    read.WaitForNotification();
    return PlanTo(belief, request.robot, 1.0);
  });
  PlanStreamClient stream(*planning_, Order());
  const v1::Plan better = stream.Read();
  EXPECT_EQ(better.name(), "");
  EXPECT_EQ(better.candidates(0).goal().position().x_m(), 3.0);
  const std::int64_t revision = Revision();
  read.Notify();
  const v1::Plan last = stream.Read();
  EXPECT_EQ(last.name(), "missions/hall/plans/1");
  EXPECT_EQ(last.candidates(0).goal().position().x_m(), 1.0);
  EXPECT_TRUE(stream.Finish().ok());
  EXPECT_EQ(Revision(), revision + 1) << "only the last was committed";
}

// The reader does not read while the search finds them.
TEST_F(PlanStreamTest, PlansThatTheReaderMissedAreDropped) {
  constexpr int kPlans = 20'000;  // 3 MB: beyond what the transport holds for a reader
  absl::Notification told;
  Start([&](const Belief& belief, const PlanRequest& request, const StopFn&,
            const PlanListener& improved) {
    for (int i = 0; i < kPlans; ++i) improved(PlanTo(belief, request.robot, 3.0 + i));
    told.Notify();
    return PlanTo(belief, request.robot, 1.0);
  });
  PlanStreamClient stream(*planning_, Order());
  told.WaitForNotification();
  const std::vector<v1::Plan> plans = stream.ReadAll();
  ASSERT_FALSE(plans.empty());
  EXPECT_LT(plans.size(), static_cast<std::size_t>(kPlans));
  EXPECT_EQ(plans.back().name(), "missions/hall/plans/1");
  for (std::size_t i = 2; i < plans.size(); ++i) {
    EXPECT_GT(plans[i - 1].candidates(0).goal().position().x_m(),
              plans[i - 2].candidates(0).goal().position().x_m());
  }
}

TEST_F(PlanStreamTest, SearchWithoutPlansOnTheWayHasOneMessage) {
  Start(ServerConfig{});
  PlanStreamClient stream(*planning_, Order());
  const std::vector<v1::Plan> plans = stream.ReadAll();
  ASSERT_THAT(plans, SizeIs(1));
  EXPECT_EQ(plans[0].name(), "missions/hall/plans/1");
  EXPECT_GE(plans[0].chosen_index(), 0) << plans[0].explanation();
}

TEST_F(PlanStreamTest, CostOfAGoalNeverRises) {
  ServerConfig config;
  config.mission.planning.paths = PathKind::kAnytimeXit;
  Start(config);
  PlanStreamClient stream(*planning_, Order());
  const std::vector<v1::Plan> plans = stream.ReadAll();
  ASSERT_GT(plans.size(), 1u) << "there are plans on the way";
  std::map<std::pair<int, int>, double> least;  // by the goal's cell
  for (const v1::Plan& plan : plans) {
    EXPECT_EQ(plan.name().empty(), &plan != &plans.back());
    EXPECT_GE(plan.chosen_index(), 0);
    EXPECT_GT(plan.trajectory().waypoints_size(), 1);
    for (const v1::Candidate& candidate : plan.candidates()) {
      const std::pair cell(candidate.goal().cell().column(), candidate.goal().cell().row());
      const auto [known, is_new] = least.emplace(cell, candidate.cost());
      EXPECT_LE(candidate.cost(), known->second);
      known->second = candidate.cost();
    }
  }
}

TEST_F(PlanStreamTest, BudgetEndsItWithAPlan) {
  Start([](const Belief& belief, const PlanRequest& request, const StopFn& stop,
           const PlanListener& improved) {
    improved(PlanTo(belief, request.robot, 3.0));
    while (!stop()) {
    }
    return PlanTo(belief, request.robot, 1.0);
  });
  v1::StreamNextBestTrajectoryRequest order = Order();
  order.mutable_planning_budget()->set_seconds(0);
  order.mutable_planning_budget()->set_nanos(1'000'000);
  PlanStreamClient stream(*planning_, order);
  const std::vector<v1::Plan> plans = stream.ReadAll();
  ASSERT_FALSE(plans.empty());
  EXPECT_EQ(plans.back().name(), "missions/hall/plans/1");
}

TEST_F(PlanStreamTest, CancelStopsTheSearchAndCommitsNothing) {
  absl::Notification stopped;
  Start([&](const Belief& belief, const PlanRequest& request, const StopFn& stop,
            const PlanListener& improved) {
    improved(PlanTo(belief, request.robot, 3.0));
    while (!stop()) {
    }
    stopped.Notify();
    return PlanTo(belief, request.robot, 1.0);
  });
  PlanStreamClient stream(*planning_, Order());
  EXPECT_EQ(stream.Read().name(), "");
  const std::int64_t revision = Revision();
  stream.Cancel();
  EXPECT_TRUE(absl::IsCancelled(stream.Finish()));
  stopped.WaitForNotification();
  EXPECT_EQ(Revision(), revision);
}

TEST_F(PlanStreamTest, ErrorOfTheSearchEndsTheStream) {
  Start([](const Belief&, const PlanRequest&, const StopFn&, const PlanListener&) {
    return absl::DeadlineExceededError("DEADLINE_BEFORE_FIRST_PLAN: too soon");
  });
  EXPECT_THAT(PlanStreamClient(*planning_, Order()).Finish(),
              Refuses(absl::StatusCode::kDeadlineExceeded, "DEADLINE_BEFORE_FIRST_PLAN"));
}

TEST_F(PlanStreamTest, OldLeasesGetNoPlans) {
  Start(ServerConfig{});
  ASSERT_TRUE(Register("r1", /*take_over=*/true).ok());
  EXPECT_THAT(PlanStreamClient(*planning_, Order()).Finish(),
              Refuses(absl::StatusCode::kFailedPrecondition, "LEASE_SUPERSEDED"));
}

TEST_F(PlanStreamTest, EndsWithTheServer) {
  absl::Notification searching;
  Start([&](const Belief& belief, const PlanRequest& request, const StopFn& stop,
            const PlanListener&) {
    searching.Notify();
    while (!stop()) {
    }
    return PlanTo(belief, request.robot, 1.0);
  });
  PlanStreamClient stream(*planning_, Order());
  searching.WaitForNotification();
  server_.reset();
  EXPECT_TRUE(absl::IsUnavailable(stream.Finish()));
}

}  // namespace plan_stream_test
}  // namespace plumescout::server
