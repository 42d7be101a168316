// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/map_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/types/error_reason.h"
#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "tests/server/held_store.h"
#include "tests/server/service_fixture.h"
#include "tests/support/room_run.h"

namespace plumescout::server {
namespace map_service_test {

constexpr auto kNotFound = absl::StatusCode::kNotFound;

class MapServiceTest : public ServiceTest {
 protected:
  void SetUp() override { StartServer(); }
  absl::StatusOr<v1::GetMapResponse> GetMapOf(const std::string& mission,
                                              const std::vector<int>& layers = {}) {
    v1::GetMapRequest request;
    request.set_mission(mission);
    for (const int layer : layers) request.add_layers(static_cast<v1::MapLayer>(layer));
    return Call(maps_, &v1::MapService::Stub::GetMap, request);
  }
  // Free cells take three scans.
  void SeeTheRoom() {
    const std::int64_t lease = Lease();
    for (int k = 1; k <= 3; ++k) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(k)).ok());
    ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(4, 9)).ok());
    v1::GetMapRequest request;
    request.set_mission("missions/hall");
    request.set_fresh_posterior(true);
    ASSERT_TRUE(Call(maps_, &v1::MapService::Stub::GetMap, request).ok());
  }
};

TEST_F(MapServiceTest, NewMissionHasAnEmptyMap) {
  const auto map = GetMap();
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->revision(), 0);
  EXPECT_EQ(map->status().robots_size(), 0);
  EXPECT_EQ(map->status().gas_counters().reading_count(), 0);
  EXPECT_EQ(map->status().phase(), v1::MISSION_PHASE_EXPLORING);
}

TEST_F(MapServiceTest, MapShowsWhatIsApplied) {
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(2, 3)).ok());
  const auto map = GetMap();
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->revision(), 4);
  ASSERT_EQ(map->status().robots_size(), 1);
  EXPECT_EQ(map->status().robots(0).robot(), kRobot);
  EXPECT_EQ(map->status().robots(0).applied_sequence(), 3);
  EXPECT_EQ(map->status().gas_counters().reading_count(), 2);
  ASSERT_GT(map->tiles_size(), 0);
  EXPECT_EQ(map->tiles(0).layer(), v1::MAP_LAYER_OCCUPANCY);
  EXPECT_EQ(map->tiles(0).column_count(), 64);
  EXPECT_EQ(map->tile_geometry().SerializeAsString(), map->status().geometry().SerializeAsString());
  EXPECT_TRUE(map->next_part_token().empty());
}

TEST_F(MapServiceTest, FreshPosteriorHasItsQuality) {
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_fresh_posterior(true);
  const auto map = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->status().gas_quality().refresh_count(), 1);
}

// Readings age, so epochs follow each other; who asks for the map collects the audit.
TEST_F(MapServiceTest, AuditsAreCountedInTheQuality) {
  ServerConfig config;
  config.mission = support::FastAgeing();
  StartServer(config);
  const std::int64_t lease = Lease();
  for (const Observation& observation : support::RoomRun()) {
    v1::ObservationBatch batch;
    *batch.add_observations() = ToProto(observation);
    ASSERT_TRUE(Ingest(kRobot, lease, batch).ok());
  }
  auto map = GetMap();
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_GE(map->status().gas_quality().epoch_count(), 1);
  const absl::Time patience = absl::Now() + absl::Seconds(60);
  while (map->status().gas_quality().audit_count() == 0 && absl::Now() < patience) {
    map = GetMap();
    ASSERT_TRUE(map.ok()) << map.status();
  }
  const v1::GasQuality& quality = map->status().gas_quality();
  EXPECT_GE(quality.audit_count(), 1);
  EXPECT_EQ(quality.audit_alarm_count(), 0);
  EXPECT_GT(quality.audit_mean_ppm(), 0.0);
  EXPECT_LE(quality.audit_variance_ratio(), 1e-5);
}

TEST_F(MapServiceTest, EveryReadingIsCountedOnTheMap) {
  const std::int64_t lease = Lease();
  const Pose2 middle{2.0, 1.5, 0.0};
  std::int64_t sequence = 0;
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(++sequence)).ok());
  v1::ObservationBatch batch;
  const auto add = [&](Pose2 pose, GasReading reading) {
    ++sequence;
    // Half a minute apart, in which a robot comes from anywhere to anywhere.
    *batch.add_observations() =
        ToProto(Observation{sequence, sequence * 30'000'000'000, pose, reading});
  };
  add(middle, {1.0, 0.0});
  add(middle, {1.0, 1e12});
  add({2.0, 4.02, 0.0}, {1.0, 0.0});  // in a wall
  add({500.0, 1.5, 0.0}, {1.0, 0.0});
  add(middle, {-1.0, 0.0});
  const auto ingested = Ingest(kRobot, lease, batch);
  ASSERT_TRUE(ingested.ok()) << ingested.status();
  ASSERT_EQ(ingested->rejections_size(), 1);
  EXPECT_EQ(ingested->rejections(0).sequence(), sequence);
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_fresh_posterior(true);
  const auto map = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(map.ok()) << map.status();
  const v1::GasCounters& counters = map->status().gas_counters();
  EXPECT_EQ(counters.reading_count(), 4);
  EXPECT_EQ(counters.in_posterior_count(), 3);
  EXPECT_EQ(counters.moved_count(), 1);
  EXPECT_EQ(counters.waiting_count(), 1);
  EXPECT_EQ(map->status().robots(0).rejected_observation_count(), 1);
  EXPECT_EQ(map->status().gas_quality().failure_count(), 0);
}

// On an empty mission, on a map without readings, with readings before there is a free cell.
TEST_F(MapServiceTest, PosteriorIsFreshWithoutReadingsAndWithoutFreeCells) {
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_fresh_posterior(true);
  const auto fresh = [&] { return Call(maps_, &v1::MapService::Stub::GetMap, request); };
  EXPECT_TRUE(fresh().ok());
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(1, 1)).ok());
  const auto unknown = fresh();
  ASSERT_TRUE(unknown.ok()) << unknown.status();
  EXPECT_EQ(unknown->status().gas_counters().waiting_count(), 1);
  for (int k = 2; k <= 4; ++k) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(k)).ok());
  const auto known = fresh();
  ASSERT_TRUE(known.ok()) << known.status();
  EXPECT_EQ(known->status().gas_counters().in_posterior_count(), 1);
}

TEST_F(MapServiceTest, ReadingAMapChangesNothing) {
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(2, 3)).ok());
  const auto first = GetMap();
  const auto second = GetMap();
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->SerializeAsString(), second->SerializeAsString());
  EXPECT_EQ(Revision(), 4);
}

TEST_F(MapServiceTest, OnlyTheLayersAskedForAreSent) {
  SeeTheRoom();
  const auto map = GetMapOf("missions/hall", {v1::MAP_LAYER_GAS_VARIANCE});
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_GT(map->tiles_size(), 0);
  for (const v1::MapTile& tile : map->tiles()) {
    EXPECT_EQ(tile.layer(), v1::MAP_LAYER_GAS_VARIANCE);
    EXPECT_EQ(tile.encoding(), v1::MapTile::ENCODING_U16_SCALED);
  }
}

TEST_F(MapServiceTest, FullPrecisionIsFloat) {
  SeeTheRoom();
  const auto map = GetMap(/*full_precision=*/true);
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_GT(map->tiles_size(), 0);
  const v1::MapTile& last = map->tiles(map->tiles_size() - 1);
  EXPECT_EQ(last.layer(), v1::MAP_LAYER_GAS_VARIANCE);
  EXPECT_EQ(last.encoding(), v1::MapTile::ENCODING_F32);
}

TEST_F(MapServiceTest, PartsMakeTheMap) {
  SeeTheRoom();
  const auto whole = GetMap(/*full_precision=*/true);
  ASSERT_TRUE(whole.ok()) << whole.status();
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_full_precision(true);
  request.set_max_part_bytes(1);
  auto part = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(part.ok()) << part.status();
  v1::GetMapResponse together = *part;
  while (!part->next_part_token().empty()) {
    request.set_part_token(part->next_part_token());
    part = Call(maps_, &v1::MapService::Stub::GetMap, request);
    ASSERT_TRUE(part.ok()) << part.status();
    EXPECT_EQ(part->tiles_size(), 1);
    EXPECT_FALSE(part->has_status());
    together.mutable_tiles()->MergeFrom(part->tiles());
  }
  together.clear_next_part_token();
  EXPECT_EQ(together.SerializeAsString(), whole->SerializeAsString());
}

TEST_F(MapServiceTest, TokenIsForItsRequestAlone) {
  SeeTheRoom();
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_max_part_bytes(1);
  const auto part = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(part.ok()) << part.status();
  request.set_part_token(part->next_part_token());
  request.set_level_of_detail(1);
  EXPECT_THAT(Call(maps_, &v1::MapService::Stub::GetMap, request).status(),
              RefusesField("part_token"));
}

TEST_F(MapServiceTest, NoPartIsLargerThanTheServerAllows) {
  ServerConfig config;
  config.maps.max_part_bytes = 3000;
  StartServer(config);
  SeeTheRoom();
  const auto part = GetMap(/*full_precision=*/true);
  ASSERT_TRUE(part.ok()) << part.status();
  EXPECT_FALSE(part->next_part_token().empty());
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_full_precision(true);
  request.set_max_part_bytes(1'000'000);
  const auto asked_for_more = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(asked_for_more.ok()) << asked_for_more.status();
  EXPECT_EQ(asked_for_more->SerializeAsString(), part->SerializeAsString());
}

TEST_F(MapServiceTest, CoarseMapHasLargerSquares) {
  SeeTheRoom();
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_level_of_detail(3);
  const auto map = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->tile_geometry().resolution_m(), 0.8);
  EXPECT_EQ(map->tile_geometry().column_count(), map->status().geometry().column_count() / 8);
  const auto read = FromProto(*map);
  ASSERT_TRUE(read.ok()) << read.status();
  const GridGeometry& squares = read->occupancy.geometry();
  EXPECT_EQ(read->occupancy[squares.CellAt({2.0, 1.5})], CellState::kFree);
  EXPECT_EQ(read->occupancy[squares.CellAt({2.0, 4.0})], CellState::kOccupied);
}

TEST_F(MapServiceTest, RegionOffTheMapHasNoTiles) {
  SeeTheRoom();
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  *request.mutable_region()->mutable_min() = ToProto(Point2{500.0, 500.0});
  *request.mutable_region()->mutable_max() = ToProto(Point2{501.0, 501.0});
  const auto map = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->tiles_size(), 0);
  EXPECT_TRUE(map->has_status());
}

TEST_F(MapServiceTest, StrangersAndUnknownLayersAreRefused) {
  EXPECT_THAT(GetMapOf("missions/attic").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(GetMapOf("hall").status(), RefusesField("mission"));
  EXPECT_THAT(GetMapOf("missions/hall", {v1::MAP_LAYER_OCCUPANCY, 99}).status(),
              RefusesField("layers[1]"));
}

TEST_F(MapServiceTest, GasIsToldPointByPoint) {
  const std::int64_t lease = Lease();
  for (int k = 1; k <= 3; ++k) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(k)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(4, 13)).ok());  // 1 ppm at (2, 1.5)
  v1::QueryGasRequest request;
  request.set_mission("missions/hall");
  request.set_fresh_posterior(true);
  for (const Point2 point : {Point2{2.0, 1.5}, Point2{5.5, 3.5}, Point2{2.0, 4.02}, {500.0, 0.0}}) {
    *request.add_points() = ToProto(point);
  }
  const auto response = Call(maps_, &v1::MapService::Stub::QueryGas, request);
  ASSERT_TRUE(response.ok()) << response.status();
  ASSERT_EQ(response->gas_size(), 4);
  EXPECT_EQ(response->gas(0).state(), v1::CELL_STATE_FREE);
  EXPECT_TRUE(response->gas(0).observed());
  EXPECT_GT(response->gas(0).mean_ppm(), 0.5);
  EXPECT_FALSE(response->gas(1).observed());
  EXPECT_GT(response->gas(1).variance_ppm2(), response->gas(0).variance_ppm2());
  EXPECT_EQ(response->gas(2).state(), v1::CELL_STATE_OCCUPIED);
  EXPECT_FALSE(response->gas(2).has_mean_ppm());
  EXPECT_EQ(response->gas(3).state(), v1::CELL_STATE_OFF_MAP);
  EXPECT_LT(response->gas(0).nearest_reading_m(), 0.075) << "half a diagonal of a cell";
  EXPECT_NEAR(response->gas(3).nearest_reading_m(), 498.0, 0.075);
  for (const v1::GasAtPoint& gas : response->gas()) {
    EXPECT_EQ(gas.nearest_reading_time_ns(), 13'000'000);
  }
  EXPECT_EQ(response->sample_time_ns(), 13'000'000);
  EXPECT_EQ(response->posterior_time_ns(), 13'000'000);
  EXPECT_EQ(response->gas_quality().refresh_count(), 1);
  EXPECT_EQ(response->revision(), Revision());
}

TEST_F(MapServiceTest, GasOfAnEmptyMapIsOffTheMap) {
  v1::QueryGasRequest request;
  request.set_mission("missions/hall");
  request.add_points();
  const auto response = Call(maps_, &v1::MapService::Stub::QueryGas, request);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->gas(0).state(), v1::CELL_STATE_OFF_MAP);
  EXPECT_FALSE(response->gas(0).has_nearest_reading_m());
  EXPECT_EQ(Revision(), 0);
}

// Reads of journals wait until they may go on.
class SlowJournal final : public HeldStore {
 public:
  absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string& key,
                                                      std::int64_t first_number) override {
    if (!reads.HasBeenNotified()) reads.Notify();
    go_on.WaitForNotification();
    return HeldStore::Read(key, first_number);
  }

  absl::Notification reads;
  absl::Notification go_on;
};

class PastMapTest : public MapServiceTest {
 protected:
  ~PastMapTest() override { server_ = nullptr; }  // it uses the store

  // A server whose looks at the past wait, of a mission that has one.
  void StartSlowly(const MapConfig& maps) {
    ServerConfig config;
    config.maps = maps;
    RegistryHooks hooks;
    hooks.store = &store_;
    server_ = nullptr;
    StartServer(config, hooks);
    SeeTheRoom();
  }
  absl::Status LookAtThePast() {
    v1::GetMapRequest request;
    request.set_mission("missions/hall");
    request.set_revision(1);
    return Call(maps_, &v1::MapService::Stub::GetMap, request).status();
  }

  SlowJournal store_;
};

TEST_F(PastMapTest, KeepsNobodyFromWhatIsNow) {
  StartSlowly({.query_threads = 1});
  std::thread looks([&] { EXPECT_TRUE(LookAtThePast().ok()); });
  store_.reads.WaitForNotification();
  EXPECT_TRUE(GetMap().ok());  // would wait for its deadline
  store_.go_on.Notify();
  looks.join();
}

TEST_F(PastMapTest, OneCallersLooksLeaveRoomForOthers) {
  StartSlowly({.max_queued_queries = 4});
  std::atomic<int> refused = 0;
  std::vector<std::thread> looks;
  for (int i = 0; i < 4; ++i) {  // one is at it and two wait: the fourth is beyond its share
    looks.emplace_back([&] {
      if (ErrorReason(LookAtThePast()) == reason::kOverloaded) ++refused;
    });
    store_.reads.WaitForNotification();
  }
  while (refused == 0) std::this_thread::yield();
  EXPECT_TRUE(GetMap().ok());
  store_.go_on.Notify();
  for (std::thread& look : looks) look.join();
  EXPECT_EQ(refused, 1);
}

TEST_F(MapServiceTest, WatchersAreServedToo) {
  WatchClient watch(*maps_);
  EXPECT_EQ(watch.Read().kind(), v1::WatchMapResponse::KIND_FULL);
}

}  // namespace map_service_test
}  // namespace plumescout::server
