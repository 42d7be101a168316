// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Maps of missions that map several gases, as clients see them.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace map_species_test {

constexpr char kMission[] = "missions/plant";
constexpr char kReader[] = "missions/plant/robots/r1";
constexpr char kSecond[] = "hydrogen-sulfide";
constexpr Point2 kPlace{2.0, 1.5};

// A robot has seen a room from one place and read 10 ppm of methane there five times, and 2 ppm of
// hydrogen sulphide four times.
class MapSpeciesTest : public ServiceTest {
 protected:
  void SetUp() override {
    StartServerWithStore();
    v1::MissionOptions options;
    options.add_gas_species()->set_name("methane");
    options.add_gas_species()->set_name(kSecond);
    ASSERT_TRUE(CreateMission("plant", options).ok());
    const auto registered = Join(kSecond);
    ASSERT_TRUE(registered.ok()) << registered.status();
    lease_ = registered->lease_token();
    for (int k = 1; k <= 3; ++k) ASSERT_TRUE(Ingest(kReader, lease_, RoomScan(k)).ok());
    v1::ObservationBatch batch;
    for (std::int64_t sequence = 4; sequence <= 12; ++sequence) {
      const bool is_first = sequence % 2 == 0;
      GasReading reading{is_first ? 10.0 : 2.0, 0.0};
      reading.sensor = is_first ? 0 : 1;
      *batch.add_observations() = ToProto(
          Observation{sequence, sequence * 1'000'000, {kPlace.x_m, kPlace.y_m, 0.0}, reading});
    }
    const auto ingested = Ingest(kReader, lease_, batch);
    ASSERT_TRUE(ingested.ok()) << ingested.status();
    ASSERT_EQ(ingested->rejections_size(), 0);
  }
  absl::StatusOr<v1::RegisterRobotResponse> Join(const std::string& second,
                                                 const std::string& robot = "r1") {
    v1::RegisterRobotRequest request;
    request.set_mission(kMission);
    request.set_robot_id(robot);
    request.set_radius_m(0.2);
    request.add_gas_sensors()->set_id("pid");
    request.add_gas_sensors()->set_id("ec");
    request.mutable_gas_sensors(1)->set_species(second);
    return Call(robots_, &v1::RobotService::Stub::RegisterRobot, request);
  }
  static v1::GetMapRequest MapOf(const std::string& species) {
    v1::GetMapRequest request;
    request.set_mission(kMission);
    request.set_full_precision(true);
    request.set_fresh_posterior(true);
    if (!species.empty()) request.add_species(species);
    return request;
  }
  absl::StatusOr<v1::GetMapResponse> Get(const v1::GetMapRequest& request) {
    return Call(maps_, &v1::MapService::Stub::GetMap, request);
  }

  std::int64_t lease_ = 0;
};

float At(const Grid<float>& field, Point2 place) {
  return field.At(field.geometry().CellAt(place), -1.0F);
}

TEST_F(MapSpeciesTest, EachGasHasItsOwnLayers) {
  const auto response = Get(MapOf(kSecond));
  ASSERT_TRUE(response.ok()) << response.status();
  const auto map = FromProto(*response);
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_EQ(map->further_gases.size(), 1u);
  EXPECT_EQ(map->further_gases[0].species, kSecond);
  EXPECT_NEAR(At(map->further_gases[0].mean_ppm, kPlace), 2.0, 0.5);
  EXPECT_EQ(map->occupancy.At(map->occupancy.geometry().CellAt(kPlace), CellState::kUnknown),
            CellState::kFree);
  const auto first = FromProto(Get(MapOf("")).value());
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_TRUE(first->further_gases.empty());
  EXPECT_NEAR(At(first->gas_mean_ppm, kPlace), 10.0, 2.0);
  const auto named = FromProto(Get(MapOf("methane")).value());
  EXPECT_EQ(At(named->gas_mean_ppm, kPlace), At(first->gas_mean_ppm, kPlace));
}

TEST_F(MapSpeciesTest, TheStatusTellsOfEachGas) {
  const auto map = Get(MapOf(""));
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_EQ(map->status().gases_size(), 2);
  EXPECT_EQ(map->status().gases(0).species(), "methane");
  EXPECT_EQ(map->status().gases(0).gas_counters().reading_count(), 5);
  EXPECT_EQ(map->status().gases(1).species(), kSecond);
  EXPECT_EQ(map->status().gases(1).gas_counters().reading_count(), 4);
  EXPECT_EQ(map->status().gases(1).gas_counters().in_posterior_count(), 4);
  EXPECT_GE(map->status().gases(1).gas_quality().refresh_count(), 1);
  EXPECT_EQ(map->status().gas_counters().reading_count(), 5) << "of the first";
}

TEST_F(MapSpeciesTest, PlacesAreAskedOfOneGas) {
  v1::QueryGasRequest request;
  request.set_mission(kMission);
  request.set_fresh_posterior(true);
  *request.add_points() = ToProto(kPlace);
  request.set_species(kSecond);
  const auto second = Call(maps_, &v1::MapService::Stub::QueryGas, request);
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_NEAR(second->gas(0).mean_ppm(), 2.0, 0.5);
  request.clear_species();
  const auto first = Call(maps_, &v1::MapService::Stub::QueryGas, request);
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_NEAR(first->gas(0).mean_ppm(), 10.0, 2.0);
}

TEST_F(MapSpeciesTest, PlacesAreAskedOfThePast) {
  v1::QueryGasRequest request;
  request.set_mission(kMission);
  request.set_fresh_posterior(true);
  request.set_species(kSecond);
  *request.add_points() = ToProto(Point2{3.0, 2.0});
  const auto now = Call(maps_, &v1::MapService::Stub::QueryGas, request);
  ASSERT_TRUE(now.ok()) << now.status();
  EXPECT_EQ(now->gas(0).nearest_reading_time_ns(), 11'000'000) << "the last one was of the first";
  EXPECT_EQ(now->sample_time_ns(), 12'000'000);
  v1::ObservationBatch batch;
  GasReading reading{4.0, 0.0};
  reading.sensor = 1;
  *batch.add_observations() =
      ToProto(Observation{13, 20'000'000, {kPlace.x_m + 1.0, kPlace.y_m, 0.0}, reading});
  ASSERT_TRUE(Ingest(kReader, lease_, batch).ok());
  const auto later = Call(maps_, &v1::MapService::Stub::QueryGas, request);
  ASSERT_TRUE(later.ok()) << later.status();
  EXPECT_EQ(later->gas(0).nearest_reading_time_ns(), 20'000'000);
  request.set_revision(now->revision());
  const auto then = Call(maps_, &v1::MapService::Stub::QueryGas, request);
  ASSERT_TRUE(then.ok()) << then.status();
  EXPECT_EQ(then->SerializeAsString(), now->SerializeAsString());
  request.set_revision(later->revision() + 1000);
  EXPECT_THAT(Call(maps_, &v1::MapService::Stub::QueryGas, request).status(),
              Refuses(absl::StatusCode::kOutOfRange, "OUT_OF_RANGE"));
}

TEST_F(MapSpeciesTest, WatchersAndThePastAreServedToo) {
  const auto now = Get(MapOf(kSecond));
  ASSERT_TRUE(now.ok()) << now.status();
  v1::WatchMapRequest watch;
  watch.set_mission(kMission);
  watch.set_full_precision(true);
  watch.add_layers(v1::MAP_LAYER_GAS_MEAN);
  watch.add_species(kSecond);
  const v1::WatchMapResponse frame = WatchClient(*maps_, watch).Read();
  EXPECT_EQ(frame.kind(), v1::WatchMapResponse::KIND_FULL);
  ASSERT_GT(frame.tiles_size(), 0);
  for (const v1::MapTile& tile : frame.tiles()) EXPECT_EQ(tile.species(), kSecond);
  ASSERT_TRUE(Ingest(kReader, lease_, RoomScan(13, {5.0, 3.0, 0.0})).ok());
  v1::GetMapRequest request = MapOf(kSecond);
  request.set_revision(now->revision());
  const auto then = Get(request);
  ASSERT_TRUE(then.ok()) << then.status();
  ASSERT_EQ(then->tiles_size(), now->tiles_size());
  for (int i = 0; i < now->tiles_size(); ++i) {
    EXPECT_TRUE(then->tiles(i).SerializeAsString() == now->tiles(i).SerializeAsString()) << i;
  }
}

TEST_F(MapSpeciesTest, GasesThatAreNotMappedAreRefused) {
  EXPECT_THAT(Get(MapOf("ozone")).status(), RefusesField("species[0]"));
  EXPECT_THAT(Join("ozone", "r2").status(), RefusesField("gas_sensors[1].species"));
  v1::WatchMapRequest watch;
  watch.set_mission(kMission);
  watch.add_species("methane");
  watch.add_species("ozone");
  EXPECT_THAT(WatchClient(*maps_, watch).Finish(), RefusesField("species[1]"));
}

}  // namespace map_species_test
}  // namespace plumescout::server
