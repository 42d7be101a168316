// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/e2e/hall_run.h"

#include <gtest/gtest.h>

#include <utility>

#include "absl/strings/str_cat.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "proto/convert/observation.h"
#include "tests/e2e/gas_hall.h"
#include "tests/support/same_bytes.h"

namespace plumescout::lab {
namespace {

constexpr double kDuration_s = 40.0;
constexpr std::int64_t kMaxEdgeEvaluations = 20'000;  // of each plan

class TappedStream final : public client::ObservationStream {
 public:
  TappedStream(std::unique_ptr<ObservationStream> inner, const ObservationTap& tap)
      : inner_(std::move(inner)), tap_(tap) {}

  const client::IngestState& opened() const override { return inner_->opened(); }
  absl::Status Write(const std::vector<Observation>& batch) override {
    std::vector<Observation> tapped;
    for (const Observation& observation : batch) tapped.push_back(tap_(observation));
    return inner_->Write(tapped);
  }
  absl::StatusOr<client::IngestReply> Read(absl::Duration timeout) override {
    return inner_->Read(timeout);
  }
  std::string server_boot_id() const override { return inner_->server_boot_id(); }
  absl::Status Finish() override { return inner_->Finish(); }

 private:
  const std::unique_ptr<ObservationStream> inner_;
  const ObservationTap& tap_;
};

class TappedClient final : public client::PlannerClient {
 public:
  TappedClient(client::PlannerClient& inner, ObservationTap tap)
      : inner_(inner), tap_(std::move(tap)) {}

  absl::Status CreateMission(const MissionId& mission, const MissionOptions& options) override {
    return inner_.CreateMission(mission, options);
  }
  absl::StatusOr<std::vector<MissionId>> ListMissions() override { return inner_.ListMissions(); }
  absl::Status DeleteMission(const MissionId& mission) override {
    return inner_.DeleteMission(mission);
  }
  using PlannerClient::RegisterRobot;
  absl::StatusOr<client::RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                                     double radius_m, bool take_over,
                                                     std::int64_t log_epoch,
                                                     const client::RobotOutfit& outfit) override {
    return inner_.RegisterRobot(mission, robot, radius_m, take_over, log_epoch, outfit);
  }
  absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot, std::int64_t lease_token,
                           bool force) override {
    return inner_.RemoveRobot(mission, robot, lease_token, force);
  }
  absl::StatusOr<std::unique_ptr<client::ObservationStream>> OpenObservationStream(
      const client::RobotSession& session) override {
    PLUMESCOUT_ASSIGN_OR_RETURN(auto stream, inner_.OpenObservationStream(session));
    return std::make_unique<TappedStream>(std::move(stream), tap_);
  }
  absl::StatusOr<Plan> NextBestTrajectory(const MissionId& mission,
                                          const client::PlanQuery& query) override {
    return inner_.NextBestTrajectory(mission, query);
  }
  absl::Status ReportProgress(const client::RobotSession& session, PlanId plan,
                              ProgressOutcome outcome) override {
    return inner_.ReportProgress(session, plan, outcome);
  }
  absl::StatusOr<MapSnapshot> GetMap(const MissionId& mission) override {
    return inner_.GetMap(mission);
  }

 private:
  client::PlannerClient& inner_;
  const ObservationTap tap_;
};

}  // namespace

const SceneWorld& GasHall() {
  static const SceneWorld world([] {
    absl::StatusOr<Scene> scene = MakeGasHall();
    EXPECT_TRUE(scene.ok()) << scene.status();
    return *std::move(scene);
  }());
  return world;
}

EpisodeOptions HallOptions() {
  EpisodeOptions options;
  options.mission = kHallMission;
  options.create = MissionOptions{};
  options.duration_s = kDuration_s;
  options.max_edge_evaluations = kMaxEdgeEvaluations;
  options.plan_budget = absl::InfiniteDuration();
  options.metrics_period_s = 2.0 * kDuration_s;  // before and after, but not on the way
  return options;
}

absl::StatusOr<HallRun> RunInHall(client::PlannerClient& planner, const EpisodeOptions& options) {
  HallRun run;
  PLUMESCOUT_ASSIGN_OR_RETURN(run.episode, RunEpisode(planner, GasHall(), options));
  PLUMESCOUT_ASSIGN_OR_RETURN(run.map, planner.GetMap(options.mission));
  return run;
}

std::vector<Plan> ComparablePlans(const EpisodeResult& episode) {
  std::vector<Plan> plans;
  for (const IssuedPlan& issued : episode.plans) {
    plans.push_back(issued.plan);
    plans.back().cpu_s = 0.0;
    plans.back().belief_revision = 0;
  }
  return plans;
}

bool SameMap(const MapSnapshot& a, const MapSnapshot& b) {
  return support::SameBytes(a.occupancy, b.occupancy) &&
         support::SameBytes(a.gas_mean_ppm, b.gas_mean_ppm) &&
         support::SameBytes(a.gas_variance_ppm2, b.gas_variance_ppm2) && a.robots == b.robots &&
         a.gas_counters == b.gas_counters && a.gas_threshold_ppm == b.gas_threshold_ppm;
}

std::unique_ptr<server::Server> StartServer(int port, server::RegistryHooks hooks) {
  server::ServerConfig config;
  config.listen = absl::StrCat("127.0.0.1:", port);
  config.planning.max_budget_s = 60.0;  // enough on any machine
  // Simulated time runs faster than the clock that rates go by.
  config.limits.max_scans_per_s = 0.0;
  config.limits.max_gas_readings_per_s = 0.0;
  config.limits.max_ingest_bytes_per_s = 0.0;
  config.limits.max_plans_per_s = 0.0;
  absl::StatusOr<std::unique_ptr<server::Server>> started =
      server::Server::Start(config, std::move(hooks));
  EXPECT_TRUE(started.ok()) << started.status();
  return started.ok() ? *std::move(started) : nullptr;
}

std::unique_ptr<client::PlannerClient> ClientOf(const server::Server& server) {
  return client::MakeGrpcPlannerClient({.target = absl::StrCat("127.0.0.1:", server.port())});
}

std::unique_ptr<client::PlannerClient> WithTap(client::PlannerClient& inner, ObservationTap tap) {
  return std::make_unique<TappedClient>(inner, std::move(tap));
}

Observation AsOnTheWire(const Observation& observation) {
  absl::StatusOr<Observation> arrived = FromProto(ToProto(observation), "observation");
  EXPECT_TRUE(arrived.ok()) << arrived.status();
  return arrived.ok() ? *std::move(arrived) : observation;
}

}  // namespace plumescout::lab
