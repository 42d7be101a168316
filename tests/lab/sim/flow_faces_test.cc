// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/flow_faces.h"

#include <gtest/gtest.h>

#include "tests/lab/sim/flow_domains.h"

namespace plumescout::lab {
namespace flow_faces_test {

TEST(FlowFacesTest, FreesTheFacesBetweenFluidCells) {
  FlowDomain domain = ClosedRoom(3, 2);
  domain.fluid[Cell(1, 0)] = 0;
  const FreeFaces free(domain);
  // Of 2 x 2 vertical and 3 inner horizontal faces, two and one touch the solid cell.
  EXPECT_EQ(free.all().size(), 4u);
  EXPECT_TRUE(free.IsFree({{1, 1}, Axis::kX}));
  EXPECT_FALSE(free.IsFree({{1, 0}, Axis::kX}));
  EXPECT_FALSE(free.IsFree({{2, 0}, Axis::kX}));
  EXPECT_FALSE(free.IsFree({{1, 1}, Axis::kY}));
  EXPECT_TRUE(free.IsFree({{0, 1}, Axis::kY}));
}

TEST(FlowFacesTest, KeepsTheRastersEdgeAndFansFromBeingFree) {
  FlowDomain domain = ClosedRoom(3, 2);
  domain.fans = {{{1, 0}, Side::kWest, 1.0}, {{2, 1}, Side::kSouth, -1.0}};
  const FreeFaces free(domain);
  EXPECT_FALSE(free.IsFree({{1, 0}, Axis::kX}));
  EXPECT_FALSE(free.IsFree({{2, 1}, Axis::kY}));
  EXPECT_TRUE(free.IsFree({{1, 1}, Axis::kX}));
  EXPECT_FALSE(free.IsFree({{0, 0}, Axis::kX}));
  EXPECT_FALSE(free.IsFree({{3, 0}, Axis::kX}));
  EXPECT_FALSE(free.IsFree({{0, 0}, Axis::kY}));
}

TEST(FlowFacesTest, FindsTheFacesOfOpeningsOnEverySide) {
  const MacField field(ClosedRoom(3, 2).fluid.geometry());
  const auto expect = [&](Side side, Cell cell, std::size_t outer, std::size_t inner, double in) {
    const OpeningFaces faces = FacesOf({cell, side, std::nullopt});
    EXPECT_EQ(IndexOf(faces.outer, field), outer);
    EXPECT_EQ(IndexOf(faces.inner, field), inner);
    EXPECT_EQ(faces.inward, in);
  };
  expect(Side::kWest, {0, 1}, field.UFace(0, 1), field.UFace(1, 1), 1.0);
  expect(Side::kEast, {2, 1}, field.UFace(3, 1), field.UFace(2, 1), -1.0);
  expect(Side::kSouth, {1, 0}, field.VFace(1, 0), field.VFace(1, 1), 1.0);
  expect(Side::kNorth, {1, 1}, field.VFace(1, 2), field.VFace(1, 1), -1.0);
}

}  // namespace flow_faces_test
}  // namespace plumescout::lab
