// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/map_replica.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "proto/convert/raster.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace map_replica_test {

GridGeometry Yard(int width) { return {.resolution_m = 0.5, .width = width, .height = 2}; }

Grid<CellState> AllFree(int width) { return Grid<CellState>(Yard(width), CellState::kFree); }

v1::WatchMapResponse Full(std::int64_t revision, int width) {
  v1::WatchMapResponse frame;
  frame.set_kind(v1::WatchMapResponse::KIND_FULL);
  frame.set_revision(revision);
  *frame.mutable_tile_geometry() = ToProto(Yard(width));
  *frame.add_tiles() = EncodeStates(AllFree(width), {{0, 0}, {width, 2}});
  return frame;
}

// One cell, (1, 1), becomes occupied.
v1::WatchMapResponse Delta(std::int64_t base, std::int64_t revision, int width) {
  v1::WatchMapResponse frame;
  frame.set_kind(v1::WatchMapResponse::KIND_DELTA);
  frame.set_base_revision(base);
  frame.set_revision(revision);
  Grid<CellState> states = AllFree(width);
  states[Cell{1, 1}] = CellState::kOccupied;
  *frame.add_tiles() = EncodeStates(states, {{1, 1}, {2, 2}});
  return frame;
}

TEST(MapReplicaTest, ChangesAreOnTopOfTheWholeMap) {
  MapReplica replica;
  EXPECT_FALSE(replica.whole());
  ASSERT_EQ(replica.Apply(Full(3, 4)), absl::OkStatus());
  EXPECT_TRUE(replica.whole());
  EXPECT_EQ(replica.map().revision, 3);
  EXPECT_EQ(replica.map().occupancy.geometry(), Yard(4));
  EXPECT_TRUE(std::isnan(replica.map().gas_mean_ppm[Cell{0, 0}]));
  EXPECT_EQ(replica.TakeChanges(), (MapChanges{.everything = true}));

  ASSERT_EQ(replica.Apply(Delta(3, 5, 4)), absl::OkStatus());
  EXPECT_EQ(replica.map().revision, 5);
  EXPECT_EQ((replica.map().occupancy[Cell{1, 1}]), CellState::kOccupied);
  EXPECT_EQ((replica.map().occupancy[Cell{0, 1}]), CellState::kFree);
  EXPECT_EQ(replica.TakeChanges(), (MapChanges{.rects = {{{1, 1}, {2, 2}}}}));
  EXPECT_EQ(replica.TakeChanges(), MapChanges());
}

TEST(MapReplicaTest, AMapInSeveralMessagesIsWholeWithTheLast) {
  MapReplica replica;
  v1::WatchMapResponse first = Full(3, 4);
  first.set_more_follow(true);
  ASSERT_EQ(replica.Apply(first), absl::OkStatus());
  EXPECT_FALSE(replica.whole());
  ASSERT_EQ(replica.Apply(Delta(3, 3, 4)), absl::OkStatus());
  EXPECT_TRUE(replica.whole());
  EXPECT_EQ(replica.TakeChanges(), (MapChanges{.everything = true}));
}

TEST(MapReplicaTest, TheStatusIsTheLastThatWasTold) {
  MapReplica replica;
  v1::WatchMapResponse frame = Full(3, 4);
  MapStatus status;
  status.gas_threshold_ppm = 8.0;
  status.phase = MissionPhase::kComplete;
  *frame.mutable_status() = ToProto(status, Yard(4), "house");
  ASSERT_EQ(replica.Apply(frame), absl::OkStatus());
  ASSERT_EQ(replica.Apply(Delta(3, 5, 4)), absl::OkStatus());
  EXPECT_EQ(replica.map().gas_threshold_ppm, 8.0);
  EXPECT_EQ(replica.map().phase, MissionPhase::kComplete);
  EXPECT_EQ(replica.map().revision, 5);
}

TEST(MapReplicaTest, AfterAResetANewMapFollows) {
  MapReplica replica;
  ASSERT_EQ(replica.Apply(Full(3, 4)), absl::OkStatus());
  v1::WatchMapResponse reset;
  reset.set_kind(v1::WatchMapResponse::KIND_RESET);
  ASSERT_EQ(replica.Apply(reset), absl::OkStatus());
  EXPECT_FALSE(replica.whole());
  EXPECT_EQ(FieldViolations(replica.Apply(Delta(3, 5, 4))).at(0).field, "kind");
  ASSERT_EQ(replica.Apply(Full(6, 7)), absl::OkStatus());
  EXPECT_EQ(replica.map().occupancy.width(), 7);
}

TEST(MapReplicaTest, WhatDoesNotFitIsNamed) {
  MapReplica replica;
  EXPECT_EQ(FieldViolations(replica.Apply(Delta(0, 1, 4))).at(0).field, "kind");
  ASSERT_EQ(replica.Apply(Full(3, 4)), absl::OkStatus());
  EXPECT_EQ(FieldViolations(replica.Apply(Delta(2, 5, 4))).at(0).field, "base_revision");
  ASSERT_EQ(replica.Apply(Full(3, 1)), absl::OkStatus());
  EXPECT_TRUE(absl::IsInvalidArgument(replica.Apply(Delta(3, 5, 4)))) << "beyond the raster";
}

}  // namespace map_replica_test
}  // namespace plumescout
