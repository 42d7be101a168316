// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/prior_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace plumescout {
namespace prior_map_test {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Grid<CellState> AllFree(const GridGeometry& geometry) {
  return Grid<CellState>(geometry, CellState::kFree);
}

void ExpectRefused(const GridGeometry& geometry, const OccupancyOptions& options,
                   const std::string& what) {
  const absl::Status status = ValidatePriorMap(AllFree(geometry), options);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << what;
  EXPECT_THAT(std::string(status.message()), StartsWith("prior_map "));
  EXPECT_THAT(std::string(status.message()), HasSubstr(what));
}

TEST(PriorMap, AnyPlaceOnTheLatticeWillDo) {
  for (const double origin_m : {0.0, -12.3, 0.1, 40.7}) {
    EXPECT_TRUE(ValidatePriorMap(AllFree({origin_m, -origin_m, 0.1, 30, 20}), {}).ok()) << origin_m;
  }
}

TEST(PriorMap, DecimalsThatWentThroughFloatsAreTheSameLattice) {
  OccupancyOptions options;
  options.resolution_m = 0.05;
  const double resolution_m = static_cast<double>(0.05F);
  const double origin_m = static_cast<double>(-51.2F);
  EXPECT_TRUE(
      ValidatePriorMap(AllFree({origin_m, origin_m, resolution_m, 1000, 900}), options).ok());
  EXPECT_EQ(LatticeCell({origin_m, origin_m, resolution_m, 1, 1}, 0.05), (Cell{-1024, -1024}));
}

TEST(PriorMap, AnotherResolutionIsRefusedWithBothValues) {
  for (const double resolution_m : {0.05, 0.1001, 0.0, -0.1, kNan, kInfinity}) {
    ExpectRefused({0.0, 0.0, resolution_m, 4, 4}, {}, "resolution_m = ");
    ExpectRefused({0.0, 0.0, resolution_m, 4, 4}, {}, "occupancy.resolution_m = 0.1");
  }
}

TEST(PriorMap, AnOriginBetweenCellsIsRefusedWithItsValue) {
  ExpectRefused({0.05, 0.0, 0.1, 4, 4}, {}, "origin.x_m = 0.05");
  ExpectRefused({0.0, -3.17, 0.1, 4, 4}, {}, "origin.y_m = -3.17");
  for (const double beyond_m : {kNan, kInfinity, -kInfinity, 1e300}) {
    ExpectRefused({beyond_m, 0.0, 0.1, 4, 4}, {}, "origin.x_m = ");
    ExpectRefused({0.0, beyond_m, 0.1, 4, 4}, {}, "origin.y_m = ");
  }
}

TEST(PriorMap, LimitsCountWholeTilesWithACellOfMargin) {
  OccupancyOptions options;
  options.max_extent_m = 12.8;  // two tiles of 64 cells
  EXPECT_TRUE(ValidatePriorMap(AllFree({0.1, 0.1, 0.1, 126, 1}), options).ok());
  ExpectRefused({0.1, 0.1, 0.1, 127, 1}, options, "127 x 1 cells needs 192 x 64");
  ExpectRefused({0.0, 0.1, 0.1, 126, 1}, options, "occupancy.max_extent_m = 12.8");
  options = {};
  options.max_cell_count = 2 * 64 * 64;
  EXPECT_TRUE(ValidatePriorMap(AllFree({0.1, 0.1, 0.1, 126, 1}), options).ok());
  ExpectRefused({0.1, 0.1, 0.1, 126, 63}, options, "occupancy.max_cell_count = 8192");
}

TEST(PriorMap, WithoutAFreeCellItIsRefused) {
  Grid<CellState> map({0.0, 0.0, 0.1, 3, 2}, CellState::kOccupied);
  map[Cell{1, 1}] = CellState::kUnknown;
  EXPECT_THAT(std::string(ValidatePriorMap(map, {}).message()), HasSubstr("3 x 2"));
  EXPECT_FALSE(ValidatePriorMap(Grid<CellState>({0.0, 0.0, 0.1, 0, 0}), {}).ok());
}

TEST(PriorMap, MissionsThatStartWithItHaveRoomForIt) {
  const auto map = std::make_shared<const Grid<CellState>>(AllFree(
      {.origin_x_m = 0.0, .origin_y_m = -13.0, .resolution_m = 13.0, .width = 680, .height = 74}));
  MissionOptions options;
  EXPECT_FALSE(ValidatePriorMap(*map, options.occupancy).ok());
  StartWith(map, options);
  EXPECT_EQ(options.prior_map, map);
  EXPECT_EQ(options.occupancy.resolution_m, 13.0);
  EXPECT_TRUE(Validate(options).ok()) << Validate(options);
  EXPECT_EQ(options.pose_limit_m, 680 * 13.0);
}

TEST(PriorMap, LimitsThatHoldItStayAsTheyAre) {
  MissionOptions options;
  StartWith(std::make_shared<const Grid<CellState>>(AllFree({0.0, 0.0, 0.1, 50, 40})), options);
  EXPECT_EQ(options.occupancy.max_extent_m, MissionOptions{}.occupancy.max_extent_m);
  EXPECT_EQ(options.occupancy.max_cell_count, MissionOptions{}.occupancy.max_cell_count);
  EXPECT_EQ(options.pose_limit_m, MissionOptions{}.pose_limit_m);
}

TEST(PriorMap, OptionsWithOneThatDoesNotFitAreInvalid) {
  MissionOptions options;
  options.prior_map = std::make_shared<const Grid<CellState>>(AllFree({0.0, 0.0, 0.2, 5, 4}));
  EXPECT_THAT(std::string(Validate(options).message()), HasSubstr("prior_map resolution_m = 0.2"));
}

}  // namespace prior_map_test
}  // namespace plumescout
