// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "plumescout/v1/snapshot_service.grpc.pb.h"
#include "plumescout/v1/system_service.grpc.pb.h"
#include "proto/convert/observation.h"
#include "server/server.h"
#include "tests/server/service_clients.h"
#include "tests/support/box_room.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {

inline constexpr char kRobot[] = "missions/hall/robots/r1";
inline constexpr int kAmpleBudget_s = 50;  // of a plan

// A server on a loopback port, with one mission, "hall", and calls to it.
class ServiceTest : public testing::Test {
 protected:
  void StartServer(ServerConfig config = {}, RegistryHooks hooks = {},
                   std::function<void()> drain = nullptr) {
    config.listen = "127.0.0.1:0";
    if (config.planning.max_budget_s == PlanningConfig().max_budget_s) {
      config.planning.max_budget_s = kAmpleBudget_s;
    }
    auto server = Server::Start(config, std::move(hooks), {.drain = std::move(drain)});
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
    Connect(absl::StrCat("127.0.0.1:", server_->port()));
    ASSERT_TRUE(CreateMission("hall").ok());
  }
  void Connect(const std::string& target) {
    channel_ = grpc::CreateChannel(target, grpc::InsecureChannelCredentials());
    missions_ = v1::MissionService::NewStub(channel_);
    robots_ = v1::RobotService::NewStub(channel_);
    ingest_ = v1::IngestService::NewStub(channel_);
    planning_ = v1::PlanningService::NewStub(channel_);
    maps_ = v1::MapService::NewStub(channel_);
    snapshots_ = v1::SnapshotService::NewStub(channel_);
    system_ = v1::SystemService::NewStub(channel_);
  }

  // The same, and its missions have journals.
  void StartServerWithStore(const ServerConfig& config = {}) {
    server_ = nullptr;
    store_ = std::make_unique<MemoryStore>(/*is_durable=*/true);
    RegistryHooks hooks;
    hooks.store = store_.get();
    StartServer(config, hooks);
  }

  template <typename Stub, typename Request, typename Response>
  absl::StatusOr<Response> Call(std::unique_ptr<Stub>& stub,
                                grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&,
                                                             Response*),
                                const Request& request) {
    grpc::ClientContext context;
    SetPatience(context);
    Response response;
    const absl::Status status = ToAbsl(((*stub).*method)(&context, request, &response));
    if (!status.ok()) return status;
    return response;
  }

  absl::StatusOr<v1::CreateMissionResponse> CreateMission(const std::string& id,
                                                          v1::MissionOptions options = {}) {
    v1::CreateMissionRequest request;
    request.set_mission_id(id);
    *request.mutable_options() = std::move(options);
    return Call(missions_, &v1::MissionService::Stub::CreateMission, request);
  }
  absl::StatusOr<v1::RegisterRobotResponse> Register(const std::string& robot,
                                                     bool take_over = false) {
    v1::RegisterRobotRequest request;
    request.set_mission("missions/hall");
    request.set_robot_id(robot);
    request.set_radius_m(0.2);
    request.set_take_over(take_over);
    return Call(robots_, &v1::RobotService::Stub::RegisterRobot, request);
  }
  absl::StatusOr<v1::BatchIngestObservationsResponse> Ingest(const std::string& robot,
                                                             std::int64_t lease_token,
                                                             const v1::ObservationBatch& batch) {
    v1::BatchIngestObservationsRequest request;
    request.mutable_open()->set_robot(robot);
    request.mutable_open()->set_lease_token(lease_token);
    *request.mutable_batch() = batch;
    return Call(ingest_, &v1::IngestService::Stub::BatchIngestObservations, request);
  }
  // Registers robot r1 and returns its lease token.
  std::int64_t Lease() {
    const auto registered = Register("r1");
    EXPECT_TRUE(registered.ok()) << registered.status();
    return registered.ok() ? registered->lease_token() : 0;
  }
  absl::Status DeleteMission(const std::string& id) {
    v1::DeleteMissionRequest request;
    request.set_name(absl::StrCat("missions/", id));
    return Call(missions_, &v1::MissionService::Stub::DeleteMission, request).status();
  }
  // For robot r1; with time enough for a slow machine, which a search that ends by itself leaves.
  static v1::NextBestTrajectoryRequest PlanFor(std::int64_t lease_token) {
    v1::NextBestTrajectoryRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_token);
    request.mutable_planning_budget()->set_seconds(kAmpleBudget_s);
    return request;
  }
  absl::StatusOr<v1::NextBestTrajectoryResponse> NextBest(
      const v1::NextBestTrajectoryRequest& request) {
    return Call(planning_, &v1::PlanningService::Stub::NextBestTrajectory, request);
  }
  absl::StatusOr<v1::GetMapResponse> GetMap(bool full_precision = false) {
    v1::GetMapRequest request;
    request.set_mission("missions/hall");
    request.set_full_precision(full_precision);
    return Call(maps_, &v1::MapService::Stub::GetMap, request);
  }
  std::int64_t Revision() {
    v1::GetMissionRequest request;
    request.set_name("missions/hall");
    const auto response = Call(missions_, &v1::MissionService::Stub::GetMission, request);
    return response.ok() ? response->mission().revision() : -1;
  }

  std::unique_ptr<MemoryStore> store_;  // null: of StartServer
  std::unique_ptr<Server> server_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::MissionService::Stub> missions_;
  std::unique_ptr<v1::RobotService::Stub> robots_;
  std::unique_ptr<v1::IngestService::Stub> ingest_;
  std::unique_ptr<v1::PlanningService::Stub> planning_;
  std::unique_ptr<v1::MapService::Stub> maps_;
  std::unique_ptr<v1::SnapshotService::Stub> snapshots_;
  std::unique_ptr<v1::SystemService::Stub> system_;
};

// Gas readings numbered first .. last.
inline v1::ObservationBatch GasReadings(std::int64_t first, std::int64_t last) {
  v1::ObservationBatch batch;
  for (std::int64_t sequence = first; sequence <= last; ++sequence) {
    *batch.add_observations() =
        ToProto(Observation{sequence, sequence * 1'000'000, {2.0, 1.5, 0.0}, GasReading{1.0, 0.0}});
  }
  return batch;
}

// A scan of an empty room of 6 m x 4 m, from its inside.
inline v1::ObservationBatch RoomScan(std::int64_t sequence, Pose2 pose = {2.0, 1.5, 0.0}) {
  v1::ObservationBatch batch;
  *batch.add_observations() = ToProto(
      Observation{sequence, sequence * 1'000'000, pose, support::ScanInBox(pose, 6.0, 4.0)});
  return batch;
}

}  // namespace plumescout::server
