// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What every PlannerClient promises, run against each of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "absl/strings/str_cat.h"
#include "client/error_reason.h"
#include "client/grpc_planner_client.h"
#include "client/planner_client.h"
#include "lab/local/local_planner_client.h"
#include "server/server.h"
#include "tests/client/fake_driver.h"

namespace plumescout::client {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

// Long enough for a loaded machine; never waited out by a passing test.
constexpr absl::Duration kPatience = absl::Seconds(20);
constexpr double kRadius_m = 0.2;

// A service and a client of it.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual PlannerClient& client() = 0;
};

class LocalBackend final : public Backend {
 public:
  PlannerClient& client() override { return client_; }

 private:
  lab::LocalPlannerClient client_;
};

class GrpcBackend final : public Backend {
 public:
  GrpcBackend() {
    server::ServerConfig config;
    config.listen = "127.0.0.1:0";
    auto started = server::Server::Start(config);
    EXPECT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
    client_ = MakeGrpcPlannerClient({.target = absl::StrCat("127.0.0.1:", server_->port())});
  }
  PlannerClient& client() override { return *client_; }

 private:
  std::unique_ptr<server::Server> server_;
  std::unique_ptr<PlannerClient> client_;
};

struct BackendKind {
  std::string name;
  std::function<std::unique_ptr<Backend>()> make;

  friend std::ostream& operator<<(std::ostream& out, const BackendKind& kind) {
    return out << kind.name;
  }
};

Observation GasAt(std::int64_t sequence, double x_m = 0.0) {
  return {.sequence = sequence,
          .sample_time_ns = 1'000'000'000'000 + sequence * 100'000'000,
          .pose = {.x_m = x_m},
          .payload = GasReading{.concentration_ppm = 1.0}};
}

std::vector<Observation> GasRange(std::int64_t first, std::int64_t last) {
  std::vector<Observation> batch;
  for (std::int64_t sequence = first; sequence <= last; ++sequence) {
    batch.push_back(GasAt(sequence));
  }
  return batch;
}

// What a robot sees that stands in the middle of a room of 10 x 10 m.
std::vector<Observation> LookAround(int scans) {
  FakeDriver driver(5.0);
  std::vector<Observation> batch;
  for (int i = 1; i <= scans; ++i) {
    Observation observation = GasAt(i);
    observation.pose = {.yaw_rad = 0.01 * i};
    driver.set_pose(observation.pose);
    observation.payload = *driver.TakeScan();
    batch.push_back(std::move(observation));
  }
  return batch;
}

class PlannerClientContract : public ::testing::TestWithParam<BackendKind> {
 protected:
  void SetUp() override {
    ASSERT_EQ(client().CreateMission("house", MissionOptions{}), absl::OkStatus());
  }

  PlannerClient& client() { return backend_->client(); }

  RobotSession Register(const RobotId& robot = "scout") {
    absl::StatusOr<RobotSession> session =
        client().RegisterRobot("house", robot, kRadius_m, /*take_over=*/false);
    EXPECT_TRUE(session.ok()) << session.status();
    return session.ok() ? *session : RobotSession{};
  }
  std::unique_ptr<ObservationStream> Open(const RobotSession& session) {
    auto stream = client().OpenObservationStream(session);
    EXPECT_TRUE(stream.ok()) << stream.status();
    return stream.ok() ? *std::move(stream) : nullptr;
  }

  // Reads replies until everything up to `sequence` is applied; the refused are collected.
  absl::Status ReadUntilApplied(ObservationStream& stream, std::int64_t sequence) {
    state_ = stream.opened();
    while (state_.applied_sequence < sequence) {
      absl::StatusOr<IngestReply> reply = stream.Read(kPatience);
      if (!reply.ok()) return reply.status();
      if (const auto* refused = std::get_if<ObservationRejected>(&*reply)) {
        refused_.push_back(*refused);
      } else {
        state_ = std::get<IngestState>(*reply);
      }
    }
    return absl::OkStatus();
  }
  absl::Status Send(ObservationStream& stream, const std::vector<Observation>& batch) {
    const absl::Status written = stream.Write(batch);
    return written.ok() ? ReadUntilApplied(stream, LastSequence(batch.back())) : written;
  }
  // The error that ends a stream, whichever call meets it.
  static absl::Status ReadUntilError(ObservationStream& stream) {
    while (true) {
      const absl::StatusOr<IngestReply> reply = stream.Read(kPatience);
      if (!reply.ok()) return reply.status();
    }
  }

  PlanQuery Query(const RobotSession& session, std::int64_t min_applied_sequence = 0) {
    PlanQuery query;
    query.request.robot = session.robot;
    query.lease_token = session.lease_token;
    query.min_applied_sequence = min_applied_sequence;
    query.timeout = kPatience;
    return query;
  }

  const std::unique_ptr<Backend> backend_ = GetParam().make();
  IngestState state_;
  std::vector<ObservationRejected> refused_;
};

TEST_P(PlannerClientContract, MissionsAreCreatedListedAndDeleted) {
  EXPECT_TRUE(absl::IsAlreadyExists(client().CreateMission("house", {})));
  EXPECT_TRUE(client().CreateMission("barn", {}).ok());
  EXPECT_THAT(*client().ListMissions(), ElementsAre("barn", "house"));

  EXPECT_TRUE(client().DeleteMission("house").ok());

  EXPECT_THAT(*client().ListMissions(), ElementsAre("barn"));
  EXPECT_TRUE(absl::IsNotFound(client().DeleteMission("house")));
  EXPECT_TRUE(absl::IsNotFound(client().GetMap("house").status()));
}

TEST_P(PlannerClientContract, BadNamesAndOptionsAreRefused) {
  EXPECT_TRUE(absl::IsInvalidArgument(client().CreateMission("House!", {})));
  EXPECT_TRUE(absl::IsInvalidArgument(client().CreateMission("", {})));
  MissionOptions options;
  options.gas.prior_precision = std::nan("");
  EXPECT_TRUE(absl::IsInvalidArgument(client().CreateMission("barn", options)));
  EXPECT_TRUE(absl::IsInvalidArgument(
      client().RegisterRobot("house", "Bad Robot", kRadius_m, false).status()));
  EXPECT_TRUE(
      absl::IsInvalidArgument(client().RegisterRobot("house", "scout", -1.0, false).status()));
}

TEST_P(PlannerClientContract, AFreshRobotStartsWithAnEmptyLogAndSomeCredit) {
  const RobotSession session = Register();

  EXPECT_EQ(session.mission, "house");
  EXPECT_EQ(session.robot, "scout");
  EXPECT_THAT(session.server_boot_id, Not(IsEmpty()));
  EXPECT_EQ(session.ingest.applied_sequence, 0);
  const auto stream = Open(session);
  ASSERT_NE(stream, nullptr);
  EXPECT_EQ(stream->opened().applied_sequence, 0);
  EXPECT_GT(stream->opened().credit_sequence, 0);
}

TEST_P(PlannerClientContract, RobotsOfUnknownMissionsAreNotFound) {
  EXPECT_TRUE(
      absl::IsNotFound(client().RegisterRobot("nowhere", "scout", kRadius_m, false).status()));
}

TEST_P(PlannerClientContract, ObservationsAreAcknowledgedAndNeverDurableYet) {
  const RobotSession session = Register();
  const auto stream = Open(session);

  ASSERT_EQ(Send(*stream, GasRange(1, 20)), absl::OkStatus());

  EXPECT_EQ(state_.applied_sequence, 20);
  EXPECT_EQ(state_.durable_sequence, 0);
  EXPECT_GT(state_.credit_sequence, 20);
  EXPECT_GE(state_.revision, 20);
}

TEST_P(PlannerClientContract, RepeatedObservationsAreAcknowledgedOnceMoreAndCountOnce) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, GasRange(1, 5)).ok());

  ASSERT_EQ(Send(*stream, GasRange(3, 8)), absl::OkStatus());

  EXPECT_EQ(client().GetMap("house")->gas_counters.readings, 8);
}

TEST_P(PlannerClientContract, AHoleEndsTheStreamAndNamesTheNumberExpected) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, GasRange(1, 2)).ok());

  stream->Write({GasAt(4)}).IgnoreError();  // the error may meet the write or a later read
  const absl::Status status = ReadUntilError(*stream);

  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_EQ(ErrorReason(status), kSequenceGap);
  EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("3"));
}

TEST_P(PlannerClientContract, ADeclaredGapMovesTheLogOn) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  Observation gap = GasAt(1);
  gap.payload = SequenceGap{1, 40};

  ASSERT_EQ(Send(*stream, {gap, GasAt(41)}), absl::OkStatus());

  EXPECT_EQ(state_.applied_sequence, 41);
  EXPECT_EQ(client().GetMap("house")->gas_counters.readings, 1);
}

TEST_P(PlannerClientContract, ABadObservationIsRefusedAloneAndCountsAsApplied) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  std::vector<Observation> batch = GasRange(1, 3);
  batch[1].pose.x_m = 1e9;  // beyond every mission's limit

  ASSERT_EQ(Send(*stream, batch), absl::OkStatus());

  ASSERT_EQ(refused_.size(), 1U);
  EXPECT_EQ(refused_[0].sequence, 2);
  EXPECT_FALSE(refused_[0].status.ok());
  EXPECT_EQ(state_.applied_sequence, 3);
  EXPECT_EQ(client().GetMap("house")->robots[0].rejected_observations, 1);
}

TEST_P(PlannerClientContract, ObservationsBeyondTheCreditEndTheStream) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  const std::int64_t credit = stream->opened().credit_sequence;
  Observation gap = GasAt(1);
  gap.payload = SequenceGap{1, credit};

  stream->Write({gap, GasAt(credit + 1)}).IgnoreError();
  const absl::Status status = ReadUntilError(*stream);

  EXPECT_TRUE(absl::IsResourceExhausted(status)) << status;
}

TEST_P(PlannerClientContract, ReadWithoutRepliesTimesOutAndTheStreamLivesOn) {
  const RobotSession session = Register();
  const auto stream = Open(session);

  EXPECT_TRUE(absl::IsDeadlineExceeded(stream->Read(absl::ZeroDuration()).status()));
  EXPECT_TRUE(absl::IsDeadlineExceeded(stream->Read(absl::Milliseconds(5)).status()));

  EXPECT_EQ(Send(*stream, GasRange(1, 1)), absl::OkStatus());
}

TEST_P(PlannerClientContract, ANewStreamResumesWhereTheLogEnds) {
  const RobotSession session = Register();
  {
    const auto stream = Open(session);
    ASSERT_TRUE(Send(*stream, GasRange(1, 7)).ok());
    EXPECT_EQ(stream->Finish(), absl::OkStatus());
  }

  const auto stream = Open(session);

  ASSERT_NE(stream, nullptr);
  EXPECT_EQ(stream->opened().applied_sequence, 7);
  EXPECT_EQ(Send(*stream, GasRange(8, 9)), absl::OkStatus());
}

TEST_P(PlannerClientContract, ANewStreamOfTheSameClientReplacesItsOldOne) {
  const RobotSession session = Register();
  const auto old_stream = Open(session);

  const auto stream = Open(session);

  ASSERT_NE(stream, nullptr);
  EXPECT_FALSE(ReadUntilError(*old_stream).ok());
  EXPECT_EQ(Send(*stream, GasRange(1, 1)), absl::OkStatus());
}

TEST_P(PlannerClientContract, ALeaseInUseIsNotGivenAwayUnlessTakenOver) {
  const RobotSession first = Register();
  const auto stream = Open(first);

  EXPECT_EQ(ErrorReason(client().RegisterRobot("house", "scout", kRadius_m, false).status()),
            kLeaseHeld);

  const auto second = client().RegisterRobot("house", "scout", kRadius_m, true);
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_NE(second->lease_token, first.lease_token);
  EXPECT_EQ(ErrorReason(ReadUntilError(*stream)), kLeaseSuperseded);
}

TEST_P(PlannerClientContract, AnOldLeaseIsFencedOffEverywhere) {
  const RobotSession first = Register();
  const auto second = client().RegisterRobot("house", "scout", kRadius_m, true);
  ASSERT_TRUE(second.ok());

  EXPECT_EQ(ErrorReason(client().OpenObservationStream(first).status()), kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(client().NextBestTrajectory("house", Query(first)).status()),
            kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(client().ReportProgress(first, 1, ProgressOutcome::kReached)),
            kLeaseSuperseded);
  EXPECT_NE(Open(*second), nullptr);
}

TEST_P(PlannerClientContract, ARobotWithoutAPoseCannotBePlannedFor) {
  const RobotSession session = Register();

  const absl::Status status = client().NextBestTrajectory("house", Query(session)).status();

  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
}

TEST_P(PlannerClientContract, AnUnknownRobotCannotBePlannedFor) {
  RobotSession stranger;
  stranger.robot = "stranger";
  stranger.lease_token = 1;

  EXPECT_TRUE(absl::IsNotFound(client().NextBestTrajectory("house", Query(stranger)).status()));
}

TEST_P(PlannerClientContract, AfterALookAroundThereIsATrajectoryFromTheRobot) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, LookAround(8)).ok());

  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 8));

  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_GT(plan->id, 0);
  EXPECT_EQ(plan->robot, "scout");
  EXPECT_GE(plan->belief_revision, 8);
  EXPECT_THAT(plan->explanation, Not(IsEmpty()));
  if (plan->chosen >= 0) {
    ASSERT_THAT(plan->trajectory.waypoints, Not(IsEmpty()));
    const Point2 start = plan->trajectory.waypoints.front().pose.position();
    EXPECT_LT(Distance_m(start, {0.0, 0.0}), 0.15);  // a cell's diagonal
  }
}

TEST_P(PlannerClientContract, TheSameSeedAndWorkGiveTheSamePlan) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, LookAround(8)).ok());
  PlanQuery query = Query(session, 8);
  query.request.seed = 5;
  query.request.max_edge_evaluations = 2000;
  query.budget = kPatience;

  absl::StatusOr<Plan> first = client().NextBestTrajectory("house", query);
  absl::StatusOr<Plan> second = client().NextBestTrajectory("house", query);

  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_NE(first->id, second->id);
  EXPECT_EQ(first->candidates, second->candidates);
  EXPECT_EQ(first->trajectory, second->trajectory);
}

TEST_P(PlannerClientContract, PlanningWaitsForTheRobotsOwnReadings) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, LookAround(8)).ok());

  std::thread sender([&] {
    absl::SleepFor(absl::Milliseconds(30));
    EXPECT_EQ(stream->Write(GasRange(9, 12)), absl::OkStatus());
  });
  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 12));
  sender.join();

  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_GE(plan->belief_revision, 12);
}

TEST_P(PlannerClientContract, PlanningGivesUpOnReadingsThatNeverCome) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, LookAround(8)).ok());
  PlanQuery query = Query(session, 100);
  query.timeout = absl::Milliseconds(100);

  const absl::Status status = client().NextBestTrajectory("house", query).status();

  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
}

TEST_P(PlannerClientContract, ProgressIsReportedOfKnownPlansOnly) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, LookAround(8)).ok());
  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 8));
  ASSERT_TRUE(plan.ok()) << plan.status();

  EXPECT_FALSE(client().ReportProgress(session, plan->id + 7, ProgressOutcome::kReached).ok());
  EXPECT_EQ(client().ReportProgress(session, plan->id, ProgressOutcome::kReached),
            absl::OkStatus());
}

TEST_P(PlannerClientContract, AReportMadeTwiceIsNotAnError) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(Send(*stream, LookAround(8)).ok());
  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 8));
  ASSERT_TRUE(plan.ok()) << plan.status();
  ASSERT_TRUE(client().ReportProgress(session, plan->id, ProgressOutcome::kBlocked).ok());

  EXPECT_EQ(client().ReportProgress(session, plan->id, ProgressOutcome::kBlocked),
            absl::OkStatus());
}

TEST_P(PlannerClientContract, TheMapShowsWhatWasSeen) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  std::vector<Observation> batch = LookAround(8);
  Observation gas = GasAt(9, 1.0);
  batch.push_back(gas);
  ASSERT_TRUE(Send(*stream, batch).ok());

  const absl::StatusOr<MapSnapshot> map = client().GetMap("house");

  ASSERT_TRUE(map.ok()) << map.status();
  const GridGeometry& geometry = map->occupancy.geometry();
  EXPECT_EQ(map->occupancy.At(geometry.CellAt({1.0, 0.0}), CellState::kUnknown), CellState::kFree);
  EXPECT_EQ(map->occupancy.At(geometry.CellAt({7.0, 0.0}), CellState::kUnknown),
            CellState::kUnknown);
  ASSERT_EQ(map->robots.size(), 1U);
  EXPECT_EQ(map->robots[0].id, "scout");
  EXPECT_EQ(map->robots[0].applied_sequence, 9);
  EXPECT_EQ(map->robots[0].pose.x_m, 1.0);
  EXPECT_EQ(map->gas_counters.readings, 1);
}

TEST_P(PlannerClientContract, TwoRobotsKeepTheirOwnLogs) {
  const RobotSession one = Register("one");
  const RobotSession two = Register("two");
  const auto stream_one = Open(one);
  const auto stream_two = Open(two);

  EXPECT_EQ(Send(*stream_one, GasRange(1, 5)), absl::OkStatus());
  EXPECT_EQ(Send(*stream_two, GasRange(1, 3)), absl::OkStatus());

  EXPECT_EQ(Open(one)->opened().applied_sequence, 5);
  EXPECT_EQ(Open(two)->opened().applied_sequence, 3);
}

TEST_P(PlannerClientContract, DeletingAMissionEndsItsStreams) {
  const RobotSession session = Register();
  const auto stream = Open(session);

  ASSERT_TRUE(client().DeleteMission("house").ok());

  EXPECT_TRUE(absl::IsNotFound(ReadUntilError(*stream)));
  EXPECT_TRUE(absl::IsNotFound(client().OpenObservationStream(session).status()));
}

TEST_P(PlannerClientContract, StreamsMayBeLeftUnfinished) {
  const RobotSession session = Register();
  for (int i = 0; i < 20; ++i) {
    const auto stream = Open(session);
    ASSERT_NE(stream, nullptr);
    stream->Write(GasRange(1, 50)).IgnoreError();
  }
  EXPECT_NE(Open(session), nullptr);
}

INSTANTIATE_TEST_SUITE_P(
    All, PlannerClientContract,
    ::testing::Values(BackendKind{"Local", [] { return std::make_unique<LocalBackend>(); }},
                      BackendKind{"Grpc", [] { return std::make_unique<GrpcBackend>(); }}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace plumescout::client
