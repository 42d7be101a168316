// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "plumescout/v1/snapshot_service.grpc.pb.h"
#include "tests/server/service_clients.h"

namespace plumescout::server {

// A mission that comes from a server.
class ExportClient {
 public:
  ExportClient(v1::SnapshotService::Stub& stub, const std::string& mission,
               v1::MissionFileFormat format = {}) {
    SetPatience(context_);
    v1::ExportMissionRequest request;
    request.set_mission(mission);
    request.set_format(format);
    stream_ = stub.ExportMission(&context_, request);
  }
  // A message of nothing once the stream has ended.
  v1::ExportMissionResponse Read() {
    v1::ExportMissionResponse response;
    stream_->Read(&response);
    return response;
  }
  void Cancel() { context_.TryCancel(); }
  absl::Status Finish() {
    while (Read().part_case() != v1::ExportMissionResponse::PART_NOT_SET) {
    }
    return ToAbsl(stream_->Finish());
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::ExportMissionResponse>> stream_;
};

}  // namespace plumescout::server
