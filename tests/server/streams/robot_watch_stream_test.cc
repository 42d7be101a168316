// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/robot_watch_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/host_parts.h"
#include "tests/server/robot_watch_client.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace robot_watch_stream_test {

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;

class RobotWatchStreamTest : public ServiceTest {
 protected:
  void SetUp() override {
    StartServer();
    lease_ = Lease();
  }
  template <typename Request, typename Response>
  void Steer(grpc::Status (v1::MissionService::Stub::*method)(grpc::ClientContext*, const Request&,
                                                              Response*)) {
    Request request;
    request.set_name("missions/hall");
    const auto response = Call(missions_, method, request);
    ASSERT_TRUE(response.ok()) << response.status();
  }
  v1::Robot Get() {
    v1::GetRobotRequest request;
    request.set_name(kRobot);
    const auto response = Call(robots_, &v1::RobotService::Stub::GetRobot, request);
    EXPECT_TRUE(response.ok()) << response.status();
    return response.ok() ? response->robot() : v1::Robot();
  }
  absl::Status Remove() {
    v1::RemoveRobotRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_);
    return Call(robots_, &v1::RobotService::Stub::RemoveRobot, request).status();
  }

  std::int64_t lease_ = 0;
};

TEST_F(RobotWatchStreamTest, SaysFirstHowTheRobotStands) {
  RobotWatchClient watch(*robots_, kRobot, lease_);
  const v1::WatchRobotResponse first = watch.Read();
  ASSERT_TRUE(first.has_standing());
  EXPECT_TRUE(first.standing().leased());
  EXPECT_FALSE(first.standing().paused());
}

TEST_F(RobotWatchStreamTest, TellsOfAPauseOfItsEndAndOfTheMissions) {
  RobotWatchClient watch(*robots_, kRobot, lease_);
  watch.Read();
  Steer(&v1::MissionService::Stub::PauseMission);
  EXPECT_TRUE(watch.Read().standing().paused());
  Steer(&v1::MissionService::Stub::ResumeMission);
  const v1::WatchRobotResponse resumed = watch.Read();
  ASSERT_TRUE(resumed.has_standing());
  EXPECT_FALSE(resumed.standing().paused());
  Steer(&v1::MissionService::Stub::FinishMission);
  EXPECT_TRUE(watch.Read().standing().finished());
}

// Nothing happens in the mission meanwhile: the writer sleeps.
TEST_F(RobotWatchStreamTest, TellsWhenALeaseRunsOut) {
  ServerConfig config;
  config.connection.lease_hold_s = 0.2;
  static constexpr std::chrono::seconds kBeyondTheHold{1};
  for (const bool streams : {false, true}) {
    // Where the server's clock stands, until it goes: the hold is over when the test says so.
    const auto stands = std::make_shared<std::atomic<SteadyTime>>(SteadyNow());
    RegistryHooks hooks;
    hooks.clock = [stands] {
      const SteadyTime at = stands->load();
      return at == SteadyTime::max() ? SteadyNow() + kBeyondTheHold : at;
    };
    StartServer(config, hooks);
    lease_ = Lease();
    RobotWatchClient watch(*robots_, kRobot, lease_);
    const v1::WatchRobotResponse first = watch.Read();
    EXPECT_TRUE(first.standing().leased());
    IngestClient stream(*ingest_);
    if (streams) {
      ASSERT_TRUE(stream.Open(kRobot, lease_));
      ASSERT_TRUE(stream.Read().has_opened());
      stands->store(stands->load() + kBeyondTheHold);
      EXPECT_TRUE(Get().leased()) << "as long as the stream is open";
    }
    stream.Cancel();
    stands->store(SteadyTime::max());
    v1::WatchRobotResponse notice = watch.Read();
    while (notice.has_standing() && notice.standing().leased()) notice = watch.Read();
    EXPECT_TRUE(notice.has_standing()) << "the stream has ended";
    EXPECT_FALSE(notice.standing().leased());
  }
}

TEST_F(RobotWatchStreamTest, AnotherClientsLeaseEndsIt) {
  RobotWatchClient watch(*robots_, kRobot, lease_);
  watch.Read();
  ASSERT_TRUE(Register("r1", /*take_over=*/true).ok());
  EXPECT_THAT(watch.Finish(), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
}

TEST_F(RobotWatchStreamTest, OperatorsWatchOnWhoeverHoldsTheLease) {
  RobotWatchClient watch(*robots_, kRobot, 0);
  EXPECT_TRUE(watch.Read().standing().leased());
  ASSERT_TRUE(Register("r1", /*take_over=*/true).ok());
  Steer(&v1::MissionService::Stub::PauseMission);
  EXPECT_TRUE(watch.Read().standing().paused());
  watch.Cancel();
  EXPECT_TRUE(absl::IsCancelled(watch.Finish()));
}

TEST_F(RobotWatchStreamTest, ARobotThatLeavesEndsIt) {
  RobotWatchClient watch(*robots_, kRobot, lease_);
  watch.Read();
  ASSERT_TRUE(Remove().ok());
  EXPECT_THAT(watch.Finish(), Refuses(kNotFound, "ROBOT_NOT_FOUND"));
}

TEST_F(RobotWatchStreamTest, AMissionThatIsDeletedEndsIt) {
  RobotWatchClient watch(*robots_, kRobot, lease_);
  watch.Read();
  ASSERT_TRUE(DeleteMission("hall").ok());
  EXPECT_THAT(watch.Finish(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(RobotWatchStreamTest, AServerThatGoesDownEndsIt) {
  RobotWatchClient watch(*robots_, kRobot, lease_);
  watch.Read();
  server_ = nullptr;
  EXPECT_TRUE(absl::IsUnavailable(watch.Finish()));
}

TEST_F(RobotWatchStreamTest, WhoMayNotWatchIsRefused) {
  EXPECT_THAT(RobotWatchClient(*robots_, "missions/hall/robots/r9", 0).Finish(),
              Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(RobotWatchClient(*robots_, "missions/attic/robots/r1", lease_).Finish(),
              Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(RobotWatchClient(*robots_, kRobot, lease_ - 1).Finish(),
              Refuses(kPrecondition, "LEASE_SUPERSEDED"));
  EXPECT_THAT(RobotWatchClient(*robots_, "r1", lease_).Finish(), RefusesField("robot"));
}

TEST_F(RobotWatchStreamTest, AReaderThatLagsGetsTheNewestAlone) {
  RobotWatchClient watch(*robots_, kRobot, lease_);
  constexpr int kChanges = 100;
  for (int i = 0; i < kChanges; ++i) {
    Steer(&v1::MissionService::Stub::PauseMission);
    Steer(&v1::MissionService::Stub::ResumeMission);
  }
  Steer(&v1::MissionService::Stub::FinishMission);
  int notices = 1;
  for (auto notice = watch.Read(); !notice.standing().finished(); notice = watch.Read()) {
    ASSERT_TRUE(notice.has_standing());
    ASSERT_LE(++notices, 2 * kChanges + 2);
  }
}

TEST_F(RobotWatchStreamTest, ManyWatchersOfOneRobotAreAllTold) {
  std::vector<std::unique_ptr<RobotWatchClient>> watchers;
  for (int i = 0; i < 50; ++i) {
    watchers.push_back(std::make_unique<RobotWatchClient>(*robots_, kRobot, lease_));
  }
  for (const auto& watch : watchers) EXPECT_TRUE(watch->Read().has_standing());
  Steer(&v1::MissionService::Stub::PauseMission);
  for (const auto& watch : watchers) EXPECT_TRUE(watch->Read().standing().paused());
}

TEST_F(RobotWatchStreamTest, StrangersCannotFillARobotsPlacesNorTheRobotTheirs) {
  ServerConfig config;
  config.limits.max_watchers_per_robot = 2;
  StartServer(config);
  lease_ = Lease();
  std::vector<std::unique_ptr<RobotWatchClient>> watchers;
  for (const std::int64_t token : {std::int64_t{0}, lease_}) {
    for (int i = 0; i < 2; ++i) {
      watchers.push_back(std::make_unique<RobotWatchClient>(*robots_, kRobot, token));
      EXPECT_TRUE(watchers.back()->Read().has_standing());
    }
    EXPECT_THAT(RobotWatchClient(*robots_, kRobot, token).Finish(),
                Refuses(absl::StatusCode::kResourceExhausted, "LIMIT_REACHED"));
  }
  Steer(&v1::MissionService::Stub::PauseMission);
  for (const auto& watch : watchers) EXPECT_TRUE(watch->Read().standing().paused());
}

// A robot drives away from where another comes to stand, by a plan that the server made.
class PlansOfSeveralTest : public RobotWatchStreamTest {
 protected:
  // One metre a second to the east, from where the robot is.
  static absl::StatusOr<Plan> East(const Belief& belief, const PlanRequest& request,
                                   const StopFn&) {
    Plan plan = support::PlanTo(belief, request.robot, 30.0);
    const Point2 start = belief.robots.at(request.robot).state.pose.position();
    plan.trajectory.waypoints = {{{start.x_m, start.y_m, 0.0}},
                                 {{start.x_m + 8.0, start.y_m, 0.0}, 8.0}};
    plan.trajectory.length_m = plan.trajectory.duration_s = 8.0;
    return plan;
  }
  void SetUp() override {
    StartServer({}, ScriptedHooks(&PlansOfSeveralTest::East));
    lease_ = Lease();
    const auto other = Register("r2");
    ASSERT_TRUE(other.ok());
    other_lease_ = other->lease_token();
  }
  void Tell(const std::string& robot, std::int64_t lease, double time_s, Point2 place) {
    v1::ObservationBatch batch;
    *batch.add_observations() = ToProto(Observation{++sequence_[robot],
                                                    std::llround(time_s * 1e9),
                                                    {place.x_m, place.y_m, 0.0},
                                                    GasReading{1.0, 0.0}});
    const auto response = Ingest(robot, lease, batch);
    ASSERT_TRUE(response.ok()) << response.status();
  }

  std::int64_t other_lease_ = 0;
  std::map<std::string, std::int64_t> sequence_;
};

TEST_F(PlansOfSeveralTest, WhoseWayARobotComesToStandOnIsTold) {
  const std::string other = "missions/hall/robots/r2";
  Tell(kRobot, lease_, 1.0, {0.0, 0.0});
  Tell(other, other_lease_, 1.0, {0.0, 5.0});
  RobotWatchClient watch(*robots_, kRobot, lease_);
  ASSERT_TRUE(watch.Read().has_standing());
  const auto plan = NextBest(PlanFor(lease_));
  ASSERT_TRUE(plan.ok()) << plan.status();
  // The other one has no plan, and is on the way of this one: at every look, until it is told of.
  v1::WatchRobotResponse notice;
  std::atomic<bool> told_so = false;
  std::thread reader([&] {
    notice = watch.Read();
    told_so = true;
  });
  for (double time_s = 1.0; !told_so && time_s < 8.0; time_s += 0.001) {
    Tell(other, other_lease_, time_s, {4.0, 0.0});
    Tell(kRobot, lease_, time_s, {0.1 * time_s, 0.0});
  }
  if (!told_so) watch.Cancel();
  reader.join();
  ASSERT_TRUE(notice.has_plan_invalidated()) << notice.DebugString();
  const v1::PlanInvalidated& told = notice.plan_invalidated();
  EXPECT_EQ(told.plan(), plan->plan().name());
  EXPECT_EQ(told.reason(), v1::PlanInvalidated::REASON_MEETS_ROBOT);
  EXPECT_EQ(told.robot(), other);
  EXPECT_TRUE(told.has_place());
  EXPECT_THAT(server_->MetricsText(),
              ::testing::HasSubstr("plumescout_plans_invalidated_total{reason=\"meets_robot\"} 1"));
}

}  // namespace robot_watch_stream_test
}  // namespace plumescout::server
