// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/local/local_mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "tests/client/ingest_traffic.h"
#include "tests/support/room_run.h"
#include "tests/support/scripted_strategy.h"

namespace plumescout::lab {
namespace local_mission_test {

using client::ErrorReason;
using client::GasRange;
using client::kPatience;
using support::PlanTo;
using support::ScriptedStrategy;

// A mission whose clock stands still unless told otherwise.
class LocalMissionTest : public ::testing::Test {
 protected:
  void Create(ScriptedStrategy::Script script = nullptr, LocalOptions options = {}) {
    options.clock = [this] { return now_; };
    mission_ = std::make_shared<LocalMission>(
        std::make_unique<Mission>(MissionOptions{}),
        std::make_unique<const ScriptedStrategy>(std::move(script)), options);
  }
  absl::StatusOr<client::RobotSession> Register(const RobotId& robot, bool take_over = false) {
    return mission_->Register({.robot = robot, .radius_m = 0.2, .take_over = take_over});
  }
  // Its lease.
  std::int64_t Join(const RobotId& robot) {
    const auto session = Register(robot);
    EXPECT_TRUE(session.ok()) << session.status();
    return session.ok() ? session->lease_token : 0;
  }
  static client::PlanQuery Query(const RobotId& robot, std::int64_t lease_token) {
    client::PlanQuery query;
    query.request.robot = robot;
    query.lease_token = lease_token;
    query.timeout = kPatience;
    return query;
  }

  absl::Time now_ = absl::FromUnixSeconds(1'700'000'000);
  std::shared_ptr<LocalMission> mission_;
};

TEST_F(LocalMissionTest, BadOptionsMakeNoMission) {
  MissionOptions options;
  options.occupancy.resolution_m = -1.0;

  EXPECT_TRUE(absl::IsInvalidArgument(LocalMission::Create(options, {}).status()));
}

TEST_F(LocalMissionTest, ClocksAreComparedWithTheMissionsIfItHasOne) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const auto offset_ns = [this] {
    return mission_->Snapshot()->robots.at("scout").state.clock_offset_ns;
  };
  Create();
  std::int64_t lease = Join("scout");
  ASSERT_TRUE(mission_->NoteClock("scout", lease, 5 * kSecond_ns).ok());
  EXPECT_EQ(offset_ns(), 0) << "there is none";

  LocalOptions options;
  options.mission_clock_ns = [] { return 100 * kSecond_ns; };
  Create(nullptr, options);
  lease = Join("scout");
  ASSERT_TRUE(mission_->NoteClock("scout", lease, 130 * kSecond_ns).ok());
  EXPECT_EQ(offset_ns(), -30 * kSecond_ns);
  ASSERT_TRUE(mission_->NoteClock("scout", lease, 130 * kSecond_ns + 20'000'000).ok());
  EXPECT_EQ(offset_ns(), -30 * kSecond_ns) << "as good as the same";
  ASSERT_TRUE(mission_->NoteClock("scout", lease, 130 * kSecond_ns + 20'000'001).ok());
  EXPECT_EQ(offset_ns(), -30 * kSecond_ns - 20'000'001);
  EXPECT_EQ(ErrorReason(mission_->NoteClock("scout", lease + 1, 0)), client::kLeaseSuperseded);
}

TEST_F(LocalMissionTest, ALeaseIsHeldForAWhileAfterItsLastUse) {
  LocalOptions options;
  options.lease_hold = absl::Seconds(10);
  Create(nullptr, options);
  const std::int64_t lease = Join("scout");
  now_ += absl::Seconds(8);
  ASSERT_TRUE(mission_->Report({"scout", 1}, lease).code() == absl::StatusCode::kNotFound);
  now_ += absl::Seconds(9);
  EXPECT_EQ(ErrorReason(Register("scout").status()), client::kLeaseHeld);

  now_ += absl::Seconds(1);

  const auto session = Register("scout");
  ASSERT_TRUE(session.ok()) << session.status();
  EXPECT_GT(session->lease_token, lease);
}

TEST_F(LocalMissionTest, AnOpenStreamHoldsItsLeaseHoweverQuiet) {
  Create();
  const std::int64_t lease = Join("scout");
  const auto stream = mission_->OpenStream("scout", lease);
  ASSERT_TRUE(stream.ok());
  now_ += absl::Hours(1);
  EXPECT_EQ(ErrorReason(Register("scout").status()), client::kLeaseHeld);

  mission_->CloseStream("scout", *stream);
  EXPECT_EQ(ErrorReason(Register("scout").status()), client::kLeaseHeld);
  now_ += LocalOptions{}.lease_hold;

  EXPECT_TRUE(Register("scout").ok());
}

TEST_F(LocalMissionTest, AnOldStreamDoesNotCloseTheOneThatReplacedIt) {
  Create();
  const std::int64_t lease = Join("scout");
  const std::int64_t old_stream = *mission_->OpenStream("scout", lease);
  const std::int64_t stream = *mission_->OpenStream("scout", lease);

  mission_->CloseStream("scout", old_stream);

  EXPECT_TRUE(mission_->StreamState("scout", lease, stream).ok());
  EXPECT_EQ(ErrorReason(mission_->StreamState("scout", lease, old_stream).status()),
            "STREAM_REPLACED");
}

TEST_F(LocalMissionTest, TheCreditRunsAheadOfWhatIsApplied) {
  LocalOptions options;
  options.credit_window = 5;
  Create(nullptr, options);
  const std::int64_t lease = Join("scout");
  const std::int64_t stream = *mission_->OpenStream("scout", lease);
  std::vector<client::ObservationRejected> rejected;

  ASSERT_TRUE(mission_->Ingest("scout", lease, stream, GasRange(1, 5), rejected).ok());
  EXPECT_EQ(mission_->StreamState("scout", lease, stream)->credit_sequence, 10);

  const absl::Status status = mission_->Ingest("scout", lease, stream, GasRange(6, 11), rejected);
  EXPECT_EQ(ErrorReason(status), "CREDIT_EXCEEDED");
  EXPECT_EQ(mission_->StreamState("scout", lease, stream)->applied_sequence, 5);
  EXPECT_TRUE(rejected.empty());
}

TEST_F(LocalMissionTest, APlanThatLosesTheRaceForItsGoalIsMadeOnceMore) {
  std::vector<RobotId> asked;
  std::int64_t rival_lease = 0;
  Create(
      [&](const Belief& belief, const PlanRequest& request, const StopFn&) -> absl::StatusOr<Plan> {
        asked.push_back(request.robot);
        if (asked.size() == 1) {  // meanwhile the rival is faster
          EXPECT_TRUE(mission_->NextPlan(Query("rival", rival_lease)).ok());
        }
        return PlanTo(belief, request.robot, belief.claims.empty() ? 1.0 : 5.0);
      });
  const std::int64_t lease = Join("scout");
  rival_lease = Join("rival");

  const absl::StatusOr<Plan> plan = mission_->NextPlan(Query("scout", lease));

  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->candidates[0].goal.position.x_m, 5.0);
  EXPECT_THAT(asked, ::testing::ElementsAre("scout", "rival", "scout"));
  EXPECT_EQ(mission_->Snapshot()->claims.size(), 2U);
}

TEST_F(LocalMissionTest, RobotsFetchWhatATeamPlanAssignsThem) {
  Create([](const Belief& belief, const PlanRequest& request, const StopFn&) {
    Plan plan = PlanTo(belief, request.robot, request.robot == "a" ? 1.0 : 9.0);
    plan.trajectory.waypoints.resize(1);
    return plan;
  });
  const std::int64_t lease = Join("a");
  Join("b");
  const auto team = mission_->PlanForTeam({.robots = {"a", "b"}}, absl::ZeroDuration());
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 2U);
  client::PlanQuery query = Query("a", lease);
  query.request.start = Pose2{};
  const auto fetched = mission_->NextPlan(query);
  ASSERT_TRUE(fetched.ok()) << fetched.status();
  EXPECT_EQ(fetched->id, team->plans[0].id);
  query.request.start = Pose2{3.0, 0.0, 0.0};
  EXPECT_GT(mission_->NextPlan(query)->id, team->plans[1].id) << "it has driven on";
}

TEST_F(LocalMissionTest, APlannerThatInsistsOnATakenGoalIsGivenUp) {
  int asked = 0;
  Create([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    ++asked;
    return absl::StatusOr<Plan>(PlanTo(belief, request.robot, 1.0));
  });
  ASSERT_TRUE(mission_->NextPlan(Query("rival", Join("rival"))).ok());
  asked = 0;

  const absl::Status status = mission_->NextPlan(Query("scout", Join("scout"))).status();

  EXPECT_TRUE(absl::IsAborted(status)) << status;
  EXPECT_EQ(asked, 4);
}

TEST_F(LocalMissionTest, TheBudgetStopsTheSearchAndATimeoutWithinItToo) {
  std::vector<absl::Duration> taken;
  LocalOptions options;
  options.default_budget = absl::Seconds(3);
  Create(
      [&](const Belief& belief, const PlanRequest& request, const StopFn& stop) {
        const absl::Time start = now_;
        while (!stop()) now_ += absl::Milliseconds(100);
        taken.push_back(now_ - start);
        return absl::StatusOr<Plan>(PlanTo(belief, request.robot, 1.0));
      },
      options);
  client::PlanQuery query = Query("scout", Join("scout"));
  query.budget = absl::Seconds(7);
  ASSERT_TRUE(mission_->NextPlan(query).ok());
  query.budget = absl::ZeroDuration();  // as usual here
  ASSERT_TRUE(mission_->NextPlan(query).ok());
  query.budget = absl::InfiniteDuration();
  query.timeout = absl::Seconds(5);
  ASSERT_TRUE(mission_->NextPlan(query).ok());

  EXPECT_THAT(taken, ::testing::ElementsAre(absl::Seconds(7), absl::Seconds(3), absl::Seconds(5)));
}

TEST_F(LocalMissionTest, PlansSeeEveryReadingInThePosterior) {
  std::int64_t readings_in_posterior = -1;
  Create([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    EXPECT_EQ(belief.posterior_time_ns, belief.sample_time_ns);
    readings_in_posterior = belief.gas_counters.readings;
    return absl::StatusOr<Plan>(PlanTo(belief, request.robot, 1.0));
  });
  const std::int64_t lease = Join("scout");
  const std::int64_t stream = *mission_->OpenStream("scout", lease);
  std::vector<client::ObservationRejected> rejected;
  ASSERT_TRUE(mission_->Ingest("scout", lease, stream, GasRange(1, 3), rejected).ok());

  ASSERT_TRUE(mission_->NextPlan(Query("scout", lease)).ok());

  EXPECT_EQ(readings_in_posterior, 3);
}

TEST_F(LocalMissionTest, PosteriorsAreRecomputedWhileAMissionRuns) {
  mission_ = std::make_shared<LocalMission>(
      std::make_unique<Mission>(support::FastAgeing()),
      std::make_unique<const ScriptedStrategy>(support::ScriptedStrategy::Script()),
      LocalOptions{.credit_window = 1000});
  const std::int64_t lease = Join("scout");
  const std::int64_t stream = *mission_->OpenStream("scout", lease);
  std::vector<client::ObservationRejected> rejected;
  ASSERT_TRUE(mission_->Ingest("scout", lease, stream, support::RoomRun(), rejected).ok());

  const auto belief = mission_->Snapshot();
  EXPECT_GE(belief->gas_quality.epochs, 1);
  EXPECT_GT(belief->gas_quality.refreshes, belief->gas_quality.epochs);
}

TEST_F(LocalMissionTest, EventsToldOfMakeTheSameMissionAgain) {
  std::vector<Event> events;
  LocalOptions options;
  options.on_event = [&](const Event& event) { events.push_back(event); };
  Create(nullptr, options);
  const std::int64_t lease = Join("scout");
  const auto stream = mission_->OpenStream("scout", lease);
  ASSERT_TRUE(stream.ok()) << stream.status();
  std::vector<client::ObservationRejected> rejected;
  const std::vector<Observation> run = support::RoomRun();
  ASSERT_TRUE(
      mission_->Ingest("scout", lease, *stream, {run.begin(), run.begin() + 100}, rejected).ok());

  Mission again{MissionOptions{}};
  for (const Event& event : events) {
    const auto applied = again.Apply(event.body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    EXPECT_EQ(applied->revision, event.number);
  }
  const auto belief = mission_->Snapshot();
  EXPECT_EQ(again.revision(), belief->revision);
  EXPECT_GT(again.revision(), 100);  // refreshes are events too
  EXPECT_EQ(again.Snapshot()->occupancy->values(), belief->occupancy->values());
}

TEST_F(LocalMissionTest, ClosingWakesWhoeverWaits) {
  Create([](const Belief&, const PlanRequest&, const StopFn&) -> absl::StatusOr<Plan> {
    return absl::InternalError("not to be asked");
  });
  const std::int64_t lease = Join("scout");
  const std::int64_t stream = *mission_->OpenStream("scout", lease);
  client::PlanQuery query = Query("scout", lease);
  query.min_applied_sequence = 1000;
  absl::Status planned;
  absl::Status ended;
  std::thread planner([&] { planned = mission_->NextPlan(query).status(); });
  std::thread reader([&] { ended = mission_->AwaitStreamEnd("scout", lease, stream, kPatience); });

  mission_->Close(absl::NotFoundError("MISSION_NOT_FOUND: missions/house"));
  planner.join();
  reader.join();

  EXPECT_TRUE(absl::IsNotFound(planned)) << planned;
  EXPECT_TRUE(absl::IsNotFound(ended)) << ended;
}

}  // namespace local_mission_test
}  // namespace plumescout::lab
