// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/load_watcher.h"

#include <grpcpp/grpcpp.h>

#include <utility>

#include "absl/time/clock.h"
#include "lab/bench/load/own_channel.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "proto/convert/names.h"

namespace plumescout::lab {
struct LoadWatcher::Call {
  explicit Call(const std::string& target) : stub(OwnChannel(target)) {}

  v1::MapService::Stub stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReader<v1::WatchMapResponse>> reader;
};

LoadWatcher::LoadWatcher(const std::string& target, const MissionId& mission, OnRobot on_robot)
    : on_robot_(std::move(on_robot)), call_(std::make_unique<Call>(target)) {
  v1::WatchMapRequest request;
  request.set_mission(MissionResource(mission));
  call_->reader = call_->stub.WatchMap(&call_->context, request);
  thread_ = std::thread([this] { Run(); });
}

LoadWatcher::~LoadWatcher() {
  call_->context.TryCancel();
  thread_.join();
}

void LoadWatcher::Run() {
  v1::WatchMapResponse frame;
  while (call_->reader->Read(&frame)) {
    const absl::Time arrival = absl::Now();
    ++frames_;
    if (!on_robot_) continue;
    for (const v1::RobotOnMap& robot : frame.status().robots()) {
      const auto name = ParseRobotName("robot", robot.robot());
      if (name.ok()) on_robot_(name->robot, robot.applied_sequence(), arrival);
    }
  }
  const grpc::Status end = call_->reader->Finish();
  sent_away_ = end.error_code() != grpc::StatusCode::CANCELLED;
}

}  // namespace plumescout::lab
