// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/flow_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/lab/sim/flow_domains.h"

namespace plumescout::lab {
namespace flow_parts_test {

using ::testing::HasSubstr;

FlowParts Find(const FlowDomain& domain) { return FindFlowParts(domain, FreeFaces(domain)); }

// A room of 4 x 2 cells parted by a wall, or by a fan that blows eastward.
FlowDomain TwoRooms() {
  FlowDomain domain = ClosedRoom(5, 2);
  domain.fluid[Cell(2, 0)] = 0;
  domain.fluid[Cell(2, 1)] = 0;
  return domain;
}
FlowDomain PartedByAFan() {
  FlowDomain domain = ClosedRoom(4, 2);
  domain.fans = {{{2, 0}, Side::kWest, 1.0}, {{2, 1}, Side::kWest, 1.0}};
  return domain;
}

TEST(FlowPartsTest, TellsRoomsApart) {
  const FlowParts parts = Find(TwoRooms());
  ASSERT_EQ(parts.parts.size(), 2u);
  EXPECT_EQ(parts.label[Cell(1, 1)], 0);
  EXPECT_EQ(parts.label[Cell(2, 1)], FlowParts::kNone);
  EXPECT_EQ(parts.label[Cell(3, 0)], 1);
  EXPECT_EQ(parts.parts[1].first, (Cell{3, 0}));
  EXPECT_TRUE(CheckContinuity(parts).ok());
}

TEST(FlowPartsTest, CountsWhatInletsAndFansDrive) {
  FlowDomain domain = PartedByAFan();
  domain.openings = {{{0, 0}, Side::kWest, 0.5}, {{3, 1}, Side::kEast, std::nullopt}};
  const FlowParts parts = Find(domain);
  ASSERT_EQ(parts.parts.size(), 2u);
  EXPECT_EQ(parts.parts[0].net_inflow_mps, 0.5 - 2.0);
  EXPECT_FALSE(parts.parts[0].has_outlet);
  EXPECT_EQ(parts.parts[1].net_inflow_mps, 2.0);
  EXPECT_TRUE(parts.parts[1].has_outlet);
}

TEST(FlowPartsTest, RejectsAFanThatBlowsFromOneClosedRoomIntoAnother) {
  const absl::Status status = CheckContinuity(Find(PartedByAFan()));
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr("out of the space around cell (0, 0)"));
}

TEST(FlowPartsTest, AcceptsAFanThatAirCanGoAround) {
  FlowDomain domain = PartedByAFan();
  domain.fans.pop_back();
  EXPECT_TRUE(CheckContinuity(Find(domain)).ok());
}

TEST(FlowPartsTest, RejectsAnInletIntoAClosedRoom) {
  FlowDomain domain = ClosedRoom(3, 2);
  domain.openings = {{{0, 0}, Side::kWest, 0.5}};
  EXPECT_THAT(std::string(CheckContinuity(Find(domain)).message()),
              HasSubstr("into the space around cell (0, 0)"));
}

}  // namespace flow_parts_test
}  // namespace plumescout::lab
