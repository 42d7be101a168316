// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/encoded_map.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/maps/wire_message.h"

namespace plumescout::server {
namespace encoded_map_test {

using Frame = v1::WatchMapResponse;

constexpr std::int64_t kAmple_bytes = 1 << 20;
constexpr int kTile_bytes = 1000;

// Tiles of a kilobyte each; the second is unknown, the last has changed at revision 19.
EncodedMap TestMap() {
  EncodedMap map;
  map.revision = 20;
  map.geometry_since = 5;
  map.squares = {0.0, 0.0, 0.1, 256, 64};
  v1::MapStatus status;
  status.set_phase(v1::MISSION_PHASE_GAS_PROBING);
  map.status = Serialise(status);
  for (int i = 0; i < 4; ++i) {
    v1::MapTile tile;
    tile.set_layer(v1::MAP_LAYER_OCCUPANCY);
    tile.mutable_min_cell()->set_column(64 * i);
    tile.set_deflated_data(std::string(kTile_bytes, 'x'));
    const grpc::Slice bytes = i == 1 ? grpc::Slice() : Serialise(tile);
    map.tiles.push_back({{v1::MAP_LAYER_OCCUPANCY, false, 0},
                         CellRect::Sized({64 * i, 0}, 64, 64),
                         {i == 3 ? 19 : 7, bytes}});
  }
  return map;
}

std::vector<Frame> Read(const MapFrames& frames) {
  std::vector<Frame> read(frames.messages.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_TRUE(Parse(frames.messages[i], read[i]).ok());
  }
  return read;
}

v1::GetMapResponse Read(const EncodedMap& map, const MapPart& part) {
  v1::GetMapResponse read;
  EXPECT_TRUE(Parse(Build(map, part), read).ok());
  return read;
}

TEST(EncodedMapTest, NewReaderGetsEverythingThatIsKnown) {
  const auto frames = Read(FramesSince(kHoldsNothing, TestMap(), kAmple_bytes));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), Frame::KIND_FULL);
  EXPECT_EQ(frames[0].revision(), 20);
  EXPECT_EQ(frames[0].status().phase(), v1::MISSION_PHASE_GAS_PROBING);
  EXPECT_EQ(frames[0].tile_geometry().column_count(), 256);
  EXPECT_FALSE(frames[0].more_follow());
  ASSERT_EQ(frames[0].tiles_size(), 3);
  EXPECT_EQ(frames[0].tiles(1).min_cell().column(), 128);
}

TEST(EncodedMapTest, ReaderOfAnEarlierRevisionGetsWhatHasChangedSince) {
  const auto frames = Read(FramesSince(18, TestMap(), kAmple_bytes));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), Frame::KIND_DELTA);
  EXPECT_EQ(frames[0].base_revision(), 18);
  ASSERT_EQ(frames[0].tiles_size(), 1);
  EXPECT_EQ(frames[0].tiles(0).min_cell().column(), 192);
}

TEST(EncodedMapTest, TilesThatAreUnknownNowAreSentToWhomThatIsNew) {
  const auto frames = Read(FramesSince(6, TestMap(), kAmple_bytes));
  ASSERT_EQ(frames[0].tiles_size(), 4);
  EXPECT_EQ(frames[0].tiles(1).min_cell().column(), 64);
  EXPECT_LT(frames[0].tiles(1).deflated_data().size(), 100u);
}

TEST(EncodedMapTest, StatusAloneIsProgress) {
  const auto frames = Read(FramesSince(19, TestMap(), kAmple_bytes));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), Frame::KIND_PROGRESS);
  EXPECT_EQ(frames[0].tiles_size(), 0);
  EXPECT_TRUE(frames[0].has_status());
}

TEST(EncodedMapTest, MapThatMovedIsResetAndSentWhole) {
  const auto frames = Read(FramesSince(4, TestMap(), kAmple_bytes));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].kind(), Frame::KIND_RESET);
  EXPECT_EQ(frames[0].base_revision(), 4);
  EXPECT_TRUE(frames[0].more_follow());
  EXPECT_EQ(frames[1].kind(), Frame::KIND_FULL);
  EXPECT_EQ(frames[1].tiles_size(), 3);
}

TEST(EncodedMapTest, LargeFramesComeAsSeveralThatFollowOnEachOther) {
  constexpr std::int64_t kRoomForOne_bytes = 2 * kTile_bytes;
  const auto frames = Read(FramesSince(kHoldsNothing, TestMap(), kRoomForOne_bytes));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].kind(), Frame::KIND_FULL);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(frames[i].kind(), Frame::KIND_DELTA);
    EXPECT_EQ(frames[i].base_revision(), 20);
    EXPECT_FALSE(frames[i].has_status());
    EXPECT_EQ(frames[i].more_follow(), i == 1);
  }
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.revision(), 20);
    EXPECT_EQ(frame.tiles_size(), 1);
    EXPECT_LE(frame.ByteSizeLong(), static_cast<std::size_t>(kRoomForOne_bytes));
  }
}

TEST(EncodedMapTest, PartsHaveAllTilesOnceAndTheStatusFirst) {
  const EncodedMap map = TestMap();
  std::vector<int> columns;
  std::size_t parts = 0;
  for (std::size_t tile = 0; tile < map.tiles.size(); ++parts) {
    const MapPart part = CutPart(map, tile, 2 * kTile_bytes);
    const v1::GetMapResponse read = Read(map, part);
    EXPECT_EQ(read.has_status(), parts == 0);
    EXPECT_EQ(read.revision(), 20);
    EXPECT_EQ(read.tile_geometry().column_count(), 256);
    EXPECT_LE(read.ByteSizeLong(), static_cast<std::size_t>(2 * kTile_bytes));
    for (const auto& sent : read.tiles()) columns.push_back(sent.min_cell().column());
    ASSERT_GT(part.end_tile, tile);
    tile = part.end_tile;
  }
  EXPECT_EQ(parts, 3u);
  EXPECT_EQ(columns, (std::vector<int>{0, 128, 192}));
}

TEST(EncodedMapTest, PartHasATileWhateverItsSize) {
  const EncodedMap map = TestMap();
  EXPECT_EQ(Read(map, CutPart(map, 0, 1)).tiles_size(), 1);
  EXPECT_EQ(Read(map, CutPart(map, 1, 1)).tiles(0).min_cell().column(), 128);
  EXPECT_EQ(CutPart(map, 0, kAmple_bytes).end_tile, map.tiles.size());
}

}  // namespace encoded_map_test
}  // namespace plumescout::server
