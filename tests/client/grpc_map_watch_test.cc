// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_map_watch.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "absl/synchronization/notification.h"
#include "proto/convert/geometry.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace grpc_map_watch_test {

using Writer = grpc::ServerWriter<v1::WatchMapResponse>;
using Script = std::function<grpc::Status(Writer&)>;

// A server of maps that does what a test says.
class ScriptedMaps final : public v1::MapService::Service {
 public:
  explicit ScriptedMaps(Script script) : script_(std::move(script)) {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    stub_ = v1::MapService::NewStub(server_->InProcessChannel({}));
  }
  ~ScriptedMaps() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status WatchMap(grpc::ServerContext*, const v1::WatchMapRequest*, Writer* writer) override {
    return script_(*writer);
  }
  std::unique_ptr<MapWatch> Open() { return OpenGrpcMapWatch(routes_, *stub_, {}); }

 private:
  Script script_;
  std::unique_ptr<grpc::Server> server_;
  MissionRoutes routes_;
  std::unique_ptr<v1::MapService::Stub> stub_;
};

v1::WatchMapResponse Full(std::int64_t revision) {
  v1::WatchMapResponse frame;
  frame.set_kind(v1::WatchMapResponse::KIND_FULL);
  frame.set_revision(revision);
  *frame.mutable_tile_geometry() = ToProto(GridGeometry{.width = 3, .height = 2});
  return frame;
}

v1::WatchMapResponse Progress(std::int64_t base, std::int64_t revision) {
  v1::WatchMapResponse frame;
  frame.set_kind(v1::WatchMapResponse::KIND_PROGRESS);
  frame.set_base_revision(base);
  frame.set_revision(revision);
  return frame;
}

TEST(GrpcMapWatchTest, ARevisionIsReadWhole) {
  ScriptedMaps maps([](Writer& writer) {
    v1::WatchMapResponse first = Full(3);
    first.set_more_follow(true);
    writer.Write(first);
    writer.Write(Progress(3, 3));
    writer.Write(Progress(3, 4));
    return grpc::Status(grpc::StatusCode::NOT_FOUND, "it was deleted");
  });
  const auto watch = maps.Open();
  EXPECT_EQ(*watch->Read(kPatience), (MapChanges{.everything = true}));
  EXPECT_EQ(watch->map().revision, 3);
  EXPECT_EQ(watch->map().occupancy.width(), 3);
  EXPECT_EQ(*watch->Read(kPatience), MapChanges());
  EXPECT_EQ(watch->map().revision, 4);
  EXPECT_TRUE(absl::IsNotFound(watch->Read(kPatience).status()));
}

TEST(GrpcMapWatchTest, AResetIsReadWithTheMapThatFollows) {
  ScriptedMaps maps([](Writer& writer) {
    writer.Write(Full(3));
    v1::WatchMapResponse reset;
    reset.set_kind(v1::WatchMapResponse::KIND_RESET);
    writer.Write(reset);
    writer.Write(Full(5));
    return grpc::Status::OK;
  });
  const auto watch = maps.Open();
  EXPECT_TRUE(watch->Read(kPatience).ok());
  EXPECT_TRUE(watch->Read(kPatience)->everything);
  EXPECT_EQ(watch->map().revision, 5);
  EXPECT_TRUE(absl::IsUnavailable(watch->Read(kPatience).status()));  // it has no end by itself
}

TEST(GrpcMapWatchTest, AFrameThatDoesNotFitIsTheServersFault) {
  ScriptedMaps maps([](Writer& writer) {
    writer.Write(Full(3));
    writer.Write(Progress(2, 4));
    return grpc::Status::OK;
  });
  const auto watch = maps.Open();
  EXPECT_TRUE(watch->Read(kPatience).ok());
  EXPECT_TRUE(absl::IsInternal(watch->Read(kPatience).status()));
  EXPECT_FALSE(watch->Read(kPatience).ok()) << "it is dead";
}

TEST(GrpcMapWatchTest, AQuietWatchLivesOnUntilItIsCancelled) {
  absl::Notification over;
  ScriptedMaps maps([&](Writer&) {
    over.WaitForNotification();
    return grpc::Status::OK;
  });
  const auto watch = maps.Open();
  EXPECT_TRUE(absl::IsDeadlineExceeded(watch->Read(absl::ZeroDuration()).status()));
  watch->Cancel();
  EXPECT_TRUE(absl::IsCancelled(watch->Read(kPatience).status()));
  over.Notify();
}

}  // namespace grpc_map_watch_test
}  // namespace plumescout::client
