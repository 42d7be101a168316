// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load_watcher.h"

#include <grpcpp/grpcpp.h>

#include <utility>

#include "absl/time/clock.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "proto/convert/names.h"

namespace plumescout::lab {
namespace {

constexpr int kMaxReceive_bytes = 64 << 20;  // a full frame of any map here

std::shared_ptr<grpc::Channel> Connect(const std::string& target) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(kMaxReceive_bytes);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(target, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace

struct LoadWatcher::Call {
  explicit Call(const std::string& target) : stub(Connect(target)) {}

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
    for (const v1::RobotOnMap& robot : frame.status().robots()) {
      const auto name = ParseRobotName("robot", robot.robot());
      if (name.ok()) on_robot_(name->robot, robot.applied_sequence(), arrival);
    }
  }
  call_->reader->Finish();
}

}  // namespace plumescout::lab
