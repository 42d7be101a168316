// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/map_call.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "proto/convert/raster.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace map_call_test {

// A map of two parts, whose second is gone as often as a test says.
class PartedMaps final : public v1::MapService::Service {
 public:
  PartedMaps() {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~PartedMaps() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status GetMap(grpc::ServerContext*, const v1::GetMapRequest* request,
                      v1::GetMapResponse* part) override {
    requests.push_back(*request);
    const GridGeometry geometry{.width = 2, .height = 1};
    if (request->part_token().empty()) {
      part->set_revision(4);
      *part->mutable_tile_geometry() = ToProto(geometry);
      *part->mutable_status() = ToProto(MapStatus(), geometry, "house");
      for (const char* gas : {"methane", "ammonia"})
        part->mutable_status()->add_gases()->set_species(gas);
      part->set_next_part_token("second");
      return {};
    }
    if (gone > 0) {
      --gone;
      return grpc::Status(grpc::StatusCode::ABORTED, "MAP_PARTS_GONE: begin again");
    }
    *part->add_tiles() =
        EncodeStates(Grid<CellState>(geometry, CellState::kFree), {{0, 0}, {2, 1}});
    return {};
  }
  absl::StatusOr<MapSnapshot> Fetch(bool all_gases) {
    const GrpcLink link({.target = absl::StrCat("127.0.0.1:", port_), .call_timeout = kPatience});
    v1::MapService::Stub stub(link.channel());
    return FetchMap(link, stub, v1::GetMapRequest(), all_gases);
  }

  std::vector<v1::GetMapRequest> requests;
  int gone = 0;

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(MapCallTest, PartsMakeAMap) {
  PartedMaps maps;
  const auto map = maps.Fetch(/*all_gases=*/false);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->revision, 4);
  EXPECT_EQ((map->occupancy[Cell{1, 0}]), CellState::kFree);
  ASSERT_EQ(maps.requests.size(), 2U);
  EXPECT_EQ(maps.requests[1].part_token(), "second");
}

TEST(MapCallTest, AllGasesAreAskedForByName) {
  PartedMaps maps;
  ASSERT_TRUE(maps.Fetch(/*all_gases=*/true).ok());
  ASSERT_EQ(maps.requests.size(), 3U);  // to learn their names, and two parts
  EXPECT_EQ(maps.requests[0].species_size(), 0);
  EXPECT_EQ(maps.requests[2].species_size(), 2);
}

TEST(MapCallTest, ItBeginsAgainWhereThePartsAreGone) {
  PartedMaps maps;
  maps.gone = 1;
  EXPECT_TRUE(maps.Fetch(/*all_gases=*/false).ok());
  maps.gone = 1000;
  EXPECT_TRUE(absl::IsAborted(maps.Fetch(/*all_gases=*/false).status()));
}

}  // namespace map_call_test
}  // namespace plumescout::client
