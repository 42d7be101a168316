// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/wire_message.h"

#include <gtest/gtest.h>

#include <string>

#include "plumescout/v1/map_service.pb.h"

namespace plumescout::server {
namespace wire_message_test {

v1::MapTile TileAt(int column) {
  v1::MapTile tile;
  tile.set_layer(v1::MAP_LAYER_GAS_MEAN);
  tile.mutable_min_cell()->set_column(column);
  tile.set_deflated_data(std::string(300, 'x'));  // its length takes two bytes
  return tile;
}

TEST(WireMessageTest, PartsMakeTheMessageThatTheyArePartsOf) {
  v1::WatchMapResponse whole;
  whole.set_revision(17);
  whole.mutable_status()->set_gas_threshold_ppm(2.5);
  *whole.add_tiles() = TileAt(64);
  *whole.add_tiles() = TileAt(128);

  v1::WatchMapResponse head;
  head.set_revision(17);
  WireMessage message;
  message.AddField(v1::WatchMapResponse::kTilesFieldNumber, Serialise(TileAt(64)));
  message.AddField(v1::WatchMapResponse::kStatusFieldNumber, Serialise(whole.status()));
  message.AddField(v1::WatchMapResponse::kTilesFieldNumber, Serialise(TileAt(128)));
  message.Merge(head);
  v1::WatchMapResponse read;
  ASSERT_TRUE(Parse(message.Build(), read).ok());
  EXPECT_EQ(read.SerializeAsString(), whole.SerializeAsString());
  EXPECT_EQ(message.bytes(), whole.ByteSizeLong());
  EXPECT_EQ(message.Build().Length(), whole.ByteSizeLong());
}

TEST(WireMessageTest, MessageOfNothingIsTheDefault) {
  WireMessage message;
  message.Merge(v1::WatchMapResponse());
  v1::WatchMapResponse read;
  read.set_revision(3);
  ASSERT_TRUE(Parse(message.Build(), read).ok());
  EXPECT_EQ(read.ByteSizeLong(), 0u);
}

TEST(WireMessageTest, BytesThatAreNoMessageAreRefused) {
  const grpc::Slice garbage("\xff\xff\xff");
  v1::GetMapRequest request;
  EXPECT_TRUE(absl::IsInvalidArgument(Parse(grpc::ByteBuffer(&garbage, 1), request)));
  EXPECT_TRUE(absl::IsInvalidArgument(Parse(grpc::ByteBuffer(), request)));
}

}  // namespace wire_message_test
}  // namespace plumescout::server
