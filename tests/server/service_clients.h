// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/robot_service.grpc.pb.h"
#include "plumescout/v1/snapshot_service.grpc.pb.h"
#include "proto/convert/status.h"

namespace plumescout::server {

// A status of this code whose ErrorInfo, of our domain, gives this reason.
MATCHER_P2(Refuses, code, reason, "") {
  *result_listener << arg;
  return arg.code() == code && Reason(arg) == reason;
}

// kInvalidArgument that blames this one field, for some reason.
MATCHER_P(RefusesField, field, "") {
  *result_listener << arg;
  const std::vector<FieldViolation> violations = FieldViolations(arg);
  return absl::IsInvalidArgument(arg) && !Reason(arg).empty() && violations.size() == 1 &&
         violations[0].field == field;
}

inline absl::Status ToAbsl(const grpc::Status& status) {
  if (status.ok()) return absl::OkStatus();
  google::rpc::Status proto;
  if (proto.ParseFromString(status.error_details()) && proto.code() != 0) return FromProto(proto);
  return absl::Status(static_cast<absl::StatusCode>(status.error_code()), status.error_message());
}

// Long enough for any call to end by itself, on any machine.
inline void SetPatience(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
}

// An ingest stream as a robot sees it.
class IngestClient {
 public:
  explicit IngestClient(v1::IngestService::Stub& stub) {
    SetPatience(context_);
    stream_ = stub.StreamObservations(&context_);
  }
  bool Write(const v1::StreamObservationsRequest& request) { return stream_->Write(request); }
  bool Open(const std::string& robot, std::int64_t lease_token) {
    v1::StreamObservationsRequest request;
    request.mutable_open()->set_robot(robot);
    request.mutable_open()->set_lease_token(lease_token);
    return Write(request);
  }
  bool Send(const v1::ObservationBatch& batch) {
    v1::StreamObservationsRequest request;
    *request.mutable_batch() = batch;
    return Write(request);
  }
  // An empty frame once the stream has ended.
  v1::StreamObservationsResponse Read() {
    v1::StreamObservationsResponse response;
    stream_->Read(&response);
    return response;
  }
  // Reads acknowledgements until one covers `sequence`; the last one read if the stream ends.
  v1::IngestState ReadAck(std::int64_t sequence) {
    v1::StreamObservationsResponse response;
    v1::IngestState state;
    while (state.applied_sequence() < sequence && stream_->Read(&response)) {
      if (response.has_ack()) state = response.ack();
    }
    return state;
  }
  void HalfClose() { stream_->WritesDone(); }
  void Cancel() { context_.TryCancel(); }
  // Reads what is left and returns the server's last word.
  absl::Status Finish() {
    v1::StreamObservationsResponse response;
    while (stream_->Read(&response)) {
    }
    return ToAbsl(stream_->Finish());
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<
      grpc::ClientReaderWriter<v1::StreamObservationsRequest, v1::StreamObservationsResponse>>
      stream_;
};

// A watcher of a map.
class WatchClient {
 public:
  WatchClient(v1::MapService::Stub& stub, const v1::WatchMapRequest& request) {
    SetPatience(context_);
    stream_ = stub.WatchMap(&context_, request);
  }
  explicit WatchClient(v1::MapService::Stub& stub, const std::string& mission = "missions/hall")
      : WatchClient(stub, RequestFor(mission)) {}

  // An empty frame once the stream has ended.
  v1::WatchMapResponse Read() {
    v1::WatchMapResponse frame;
    stream_->Read(&frame);
    return frame;
  }
  void Cancel() { context_.TryCancel(); }
  absl::Status Finish() {
    v1::WatchMapResponse frame;
    while (stream_->Read(&frame)) {
    }
    return ToAbsl(stream_->Finish());
  }

 private:
  static v1::WatchMapRequest RequestFor(const std::string& mission) {
    v1::WatchMapRequest request;
    request.set_mission(mission);
    return request;
  }

  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::WatchMapResponse>> stream_;
};

// A mission that is sent to a server.
class ImportClient {
 public:
  explicit ImportClient(v1::SnapshotService::Stub& stub) {
    SetPatience(context_);
    stream_ = stub.ImportMission(&context_, &response_);
  }
  bool Send(const v1::ImportMissionRequest& request) { return stream_->Write(request); }
  bool Open(const std::string& mission_id) {
    v1::ImportMissionRequest request;
    request.mutable_start()->set_mission_id(mission_id);
    return Send(request);
  }
  bool Send(const v1::MissionFilePiece& piece) {
    v1::ImportMissionRequest request;
    *request.mutable_piece() = piece;
    return Send(request);
  }
  bool Send(const v1::MissionFileEnd& end) {
    v1::ImportMissionRequest request;
    *request.mutable_end() = end;
    return Send(request);
  }
  void Cancel() { context_.TryCancel(); }
  // Without having said that no more comes.
  absl::Status AwaitEnd() { return ToAbsl(stream_->Finish()); }
  absl::StatusOr<v1::ImportMissionResponse> Finish() {
    stream_->WritesDone();
    const absl::Status status = ToAbsl(stream_->Finish());
    if (!status.ok()) return status;
    return response_;
  }

 private:
  grpc::ClientContext context_;
  v1::ImportMissionResponse response_;
  std::unique_ptr<grpc::ClientWriter<v1::ImportMissionRequest>> stream_;
};

// A robot that hears of better and better plans.
class PlanStreamClient {
 public:
  PlanStreamClient(v1::PlanningService::Stub& stub,
                   const v1::StreamNextBestTrajectoryRequest& request) {
    SetPatience(context_);
    stream_ = stub.StreamNextBestTrajectory(&context_, request);
  }

  // An empty plan once the stream has ended.
  v1::Plan Read() {
    v1::StreamNextBestTrajectoryResponse response;
    stream_->Read(&response);
    return response.plan();
  }
  std::vector<v1::Plan> ReadAll() {
    std::vector<v1::Plan> plans;
    v1::StreamNextBestTrajectoryResponse response;
    while (stream_->Read(&response)) plans.push_back(response.plan());
    return plans;
  }
  void Cancel() { context_.TryCancel(); }
  absl::Status Finish() {
    ReadAll();
    return ToAbsl(stream_->Finish());
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::StreamNextBestTrajectoryResponse>> stream_;
};

}  // namespace plumescout::server
