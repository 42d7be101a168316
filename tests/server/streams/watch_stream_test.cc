// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/watch_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  EXPECT_EQ(frame.tiles_size(), 3);
  EXPECT_EQ(frame.tiles(0).column_count(), frame.status().geometry().column_count());
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

}  // namespace watch_stream_test
}  // namespace plumescout::server
