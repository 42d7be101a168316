// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/watch_stream.h"

#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace watch_stream_test {

using Frame = v1::WatchMapResponse;

class WatchStreamTest : public ServiceTest {
 protected:
  void SetUp() override {
    ServerConfig config;
    config.maps.publish_period_s = 0.0;
    StartServer(config);
    lease_ = Lease();
  }
  void Apply(const v1::ObservationBatch& batch) {
    const auto response = Ingest(kRobot, lease_, batch);
    ASSERT_TRUE(response.ok()) << response.status();
  }

  std::int64_t lease_ = 0;
};

TEST_F(WatchStreamTest, FirstFrameIsTheWholeMap) {
  Apply(RoomScan(1));
  WatchClient watch(*maps_);
  const Frame frame = watch.Read();
  EXPECT_EQ(frame.kind(), Frame::KIND_FULL);
  EXPECT_EQ(frame.revision(), 2);
  EXPECT_FALSE(frame.more_follow());
  ASSERT_GT(frame.tiles_size(), 0);
  EXPECT_EQ(frame.tiles(0).layer(), v1::MAP_LAYER_OCCUPANCY);
  EXPECT_EQ(frame.tile_geometry().SerializeAsString(),
            frame.status().geometry().SerializeAsString());
}

TEST_F(WatchStreamTest, LargeFrameComesInSeveralMessages) {
  ServerConfig config;
  config.maps.max_part_bytes = 600;  // a status, or a tile
  StartServer(config);
  lease_ = Lease();
  Apply(RoomScan(1));
  WatchClient watch(*maps_);
  Frame frame = watch.Read();
  ASSERT_EQ(frame.kind(), Frame::KIND_FULL);
  ASSERT_TRUE(frame.more_follow());
  const std::int64_t revision = frame.revision();
  int tiles = frame.tiles_size();
  while (frame.more_follow()) {
    frame = watch.Read();
    ASSERT_EQ(frame.kind(), Frame::KIND_DELTA);
    EXPECT_EQ(frame.base_revision(), revision);
    EXPECT_EQ(frame.revision(), revision);
    EXPECT_FALSE(frame.has_status());
    tiles += frame.tiles_size();
  }
  EXPECT_GT(tiles, 1);
}

TEST_F(WatchStreamTest, ViewIsTheWatchers) {
  Apply(RoomScan(1));
  v1::WatchMapRequest request;
  request.set_mission("missions/hall");
  request.add_layers(v1::MAP_LAYER_OCCUPANCY);
  request.set_level_of_detail(2);
  request.mutable_region()->mutable_min()->set_x_m(1.0);
  request.mutable_region()->mutable_min()->set_y_m(1.0);
  *request.mutable_region()->mutable_max() = request.region().min();
  WatchClient watch(*maps_, request);
  const Frame frame = watch.Read();
  EXPECT_EQ(frame.tile_geometry().resolution_m(), 0.4);
  ASSERT_EQ(frame.tiles_size(), 1);
  EXPECT_EQ(frame.tiles(0).layer(), v1::MAP_LAYER_OCCUPANCY);
}

TEST_F(WatchStreamTest, RequestThatIsNoneIsRefused) {
  grpc::GenericStub stub(channel_);
  grpc::ClientContext context;
  SetPatience(context);
  const grpc::Slice garbage("\xff\xff\xff");
  const grpc::ByteBuffer request(&garbage, 1);
  grpc::ByteBuffer response;
  absl::Notification done;
  absl::Status status;
  stub.UnaryCall(&context, "/plumescout.v1.MapService/GetMap", {}, &request, &response,
                 [&](const grpc::Status& answer) {
                   status = ToAbsl(answer);
                   done.Notify();
                 });
  done.WaitForNotification();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
}

// More than the pool's queue would hold, were each to take a place in it.
TEST_F(WatchStreamTest, ManyWatchersOfOneMissionAreAllServed) {
  ServerConfig config;
  config.maps.max_queued = 1;
  config.limits.max_streams_per_connection = 1000;
  StartServer(config);
  lease_ = Lease();
  Apply(RoomScan(1));
  std::vector<std::unique_ptr<WatchClient>> watchers;
  for (int i = 0; i < 100; ++i) watchers.push_back(std::make_unique<WatchClient>(*maps_));
  for (const auto& watch : watchers) ASSERT_EQ(watch->Read().kind(), Frame::KIND_FULL);
  Apply(GasReadings(2, 2));
  for (const auto& watch : watchers) {
    Frame frame = watch->Read();
    while (frame.status().gas_counters().reading_count() == 0) {
      ASSERT_NE(frame.kind(), Frame::KIND_UNSPECIFIED) << watch->Finish();
      frame = watch->Read();
    }
  }
}

TEST_F(WatchStreamTest, MapThatGrewIsForgottenAndSentWhole) {
  WatchClient watch(*maps_);
  ASSERT_EQ(watch.Read().revision(), 1);
  Apply(RoomScan(1));
  const Frame reset = watch.Read();
  EXPECT_EQ(reset.kind(), Frame::KIND_RESET);
  EXPECT_EQ(reset.base_revision(), 1);
  const Frame full = watch.Read();
  EXPECT_EQ(full.kind(), Frame::KIND_FULL);
  EXPECT_EQ(full.revision(), 2);
}

TEST_F(WatchStreamTest, ChangeWithinTheMapIsSentAsTiles) {
  Apply(RoomScan(1, {1.0, 1.0, 0.0}));
  WatchClient watch(*maps_);
  ASSERT_EQ(watch.Read().kind(), Frame::KIND_FULL);
  Apply(RoomScan(2, {5.0, 3.0, 0.0}));
  const Frame delta = watch.Read();
  EXPECT_EQ(delta.kind(), Frame::KIND_DELTA);
  EXPECT_EQ(delta.base_revision(), 2);
  EXPECT_EQ(delta.revision(), 3);
  EXPECT_GT(delta.tiles_size(), 0);
}

TEST_F(WatchStreamTest, NewsWithoutACellIsProgress) {
  Apply(RoomScan(1));
  WatchClient watch(*maps_);
  ASSERT_EQ(watch.Read().kind(), Frame::KIND_FULL);
  Apply(GasReadings(2, 2));
  const Frame progress = watch.Read();
  EXPECT_EQ(progress.kind(), Frame::KIND_PROGRESS);
  EXPECT_EQ(progress.tiles_size(), 0);
  EXPECT_EQ(progress.status().gas_counters().reading_count(), 1);
}

TEST_F(WatchStreamTest, WatcherThatLagsSkipsButNeverLosesTheThread) {
  constexpr int kReadings = 300;
  WatchClient watch(*maps_);
  for (int i = 1; i <= kReadings; ++i) Apply(GasReadings(i, i));
  Frame frame = watch.Read();
  ASSERT_EQ(frame.kind(), Frame::KIND_FULL);
  while (frame.status().gas_counters().reading_count() < kReadings) {
    const std::int64_t held = frame.revision();
    frame = watch.Read();
    ASSERT_EQ(frame.base_revision(), held);
    ASSERT_GT(frame.revision(), held);
  }
  EXPECT_EQ(frame.status().gas_counters().reading_count(), kReadings);
}

TEST_F(WatchStreamTest, CancelledWatchDoesNotTroubleTheOthers) {
  WatchClient leaving(*maps_);
  ASSERT_EQ(leaving.Read().kind(), Frame::KIND_FULL);
  WatchClient staying(*maps_);
  ASSERT_EQ(staying.Read().kind(), Frame::KIND_FULL);
  leaving.Cancel();
  EXPECT_TRUE(absl::IsCancelled(leaving.Finish()));
  Apply(GasReadings(1, 1));
  EXPECT_EQ(staying.Read().revision(), 2);
}

TEST_F(WatchStreamTest, DeletedMissionEndsTheWatch) {
  WatchClient watch(*maps_);
  ASSERT_EQ(watch.Read().kind(), Frame::KIND_FULL);
  ASSERT_TRUE(DeleteMission("hall").ok());
  EXPECT_THAT(watch.Finish(), Refuses(absl::StatusCode::kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(WatchStreamTest, StrangersAndUnknownLayersAreRefused) {
  WatchClient stranger(*maps_, "missions/attic");
  EXPECT_THAT(stranger.Finish(), Refuses(absl::StatusCode::kNotFound, "MISSION_NOT_FOUND"));
  WatchClient misnamed(*maps_, "hall");
  EXPECT_THAT(misnamed.Finish(), RefusesField("mission"));
}

// A replay holds memory of the mission, and its one place for replays.
TEST_F(WatchStreamTest, WhoReadsNoMoreOfThePastIsHungUpOn) {
  ServerConfig config;
  config.limits.max_wait_s = 0.2;
  config.limits.max_gas_readings_per_s = 0.0;
  config.maps.publish_period_s = 0.0;
  StartServerWithStore(config);
  lease_ = Lease();
  Apply(RoomScan(1));
  constexpr std::int64_t kBatch = 500;
  for (std::int64_t first = 2; first < 40 * kBatch; first += kBatch) {
    v1::ObservationBatch batch = GasReadings(first, first + kBatch - 1);
    for (v1::Observation& one : *batch.mutable_observations()) {  // fields that pack badly
      one.mutable_pose()->set_x_m(0.5 + 0.01 * static_cast<double>(one.sequence() * 7 % 500));
      one.mutable_gas()->set_concentration_ppm(static_cast<double>(one.sequence() * 7919 % 100));
    }
    Apply(batch);
  }
  v1::WatchMapRequest past;
  past.set_mission("missions/hall");
  past.set_from_revision(1);
  past.set_speed_ratio(10.0);
  past.set_full_precision(true);
  grpc::ChannelArguments small;
  small.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  const auto stub = v1::MapService::NewStub(grpc::CreateCustomChannel(
      absl::StrCat("127.0.0.1:", server_->port()), grpc::InsecureChannelCredentials(), small));
  WatchClient stalled(*stub, past);
  const auto watch_again = [&] {
    WatchClient other(*maps_, past);
    const bool begun = other.Read().has_status();
    other.Cancel();
    return begun;
  };
  ASSERT_TRUE(stalled.Read().has_status());
  EXPECT_FALSE(watch_again());
  // Long before its own call would end.
  const absl::Time deadline = absl::Now() + absl::Seconds(30);
  bool begun = false;
  while (!begun && absl::Now() < deadline) begun = watch_again();
  EXPECT_TRUE(begun);
  EXPECT_FALSE(stalled.Finish().ok());
}

}  // namespace watch_stream_test
}  // namespace plumescout::server
