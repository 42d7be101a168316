// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/projection.h"

#include <gtest/gtest.h>

#include "core/types/rng.h"
#include "tests/lab/sim/flow_domains.h"

namespace plumescout::lab {
namespace projection_test {

// Rounding times the condition of a Poisson matrix of a hundred cells.
constexpr double kTolerance_mps = 1e-12;

// Random speeds on all free faces.
MacField Shaken(const FlowDomain& domain) {
  MacField field(domain.fluid.geometry());
  Rng rng(7);
  const FreeFaces free(domain);
  for (const Face& face : free.all()) field.values()[IndexOf(face, field)] = rng.Gaussian();
  return field;
}

MacField Projected(const FlowDomain& domain, MacField field) {
  auto projection = Projection::Create(domain, FreeFaces(domain));
  EXPECT_TRUE(projection.ok()) << projection.status();
  if (!projection.ok()) return field;
  EXPECT_TRUE(projection->Project(field).ok());
  return field;
}

TEST(ProjectionTest, TakesTheDivergenceOut) {
  FlowDomain domain = Channel(12, 8, 0.0);
  domain.fluid[Cell(5, 4)] = 0;
  const MacField before = Shaken(domain);
  EXPECT_GT(WorstNetOutflow_mps(domain, before), 1.0);
  EXPECT_LT(WorstNetOutflow_mps(domain, Projected(domain, before)), kTolerance_mps);
}

TEST(ProjectionTest, LeavesADivergenceFreeFieldAlone) {
  const FlowDomain domain = Channel(12, 8, 0.0);
  const MacField once = Projected(domain, Shaken(domain));
  MacField twice = Projected(domain, once);
  twice.AddScaled(once, -1.0);
  EXPECT_LT(twice.MaxMagnitudes().u_mps, kTolerance_mps);
  EXPECT_LT(twice.MaxMagnitudes().v_mps, kTolerance_mps);
}

TEST(ProjectionTest, SolvesRoomsWithoutAnyOpening) {
  FlowDomain domain = ClosedRoom(9, 7);
  for (int y = 0; y < 7; ++y) domain.fluid[Cell(4, y)] = 0;  // two of them
  const MacField field = Projected(domain, Shaken(domain));
  EXPECT_LT(WorstNetOutflow_mps(domain, field), kTolerance_mps);
  EXPECT_GT(field.MaxMagnitudes().u_mps, 0.1);
}

TEST(ProjectionTest, KeepsTheSpeedOfFans) {
  FlowDomain domain = ClosedRoom(9, 7);
  domain.fans = {{{4, 3}, Side::kWest, 2.0}};
  MacField field(domain.fluid.geometry());
  field.u(4, 3) = 2.0;
  field = Projected(domain, field);
  EXPECT_EQ(field.u(4, 3), 2.0);
  EXPECT_LT(WorstNetOutflow_mps(domain, field), kTolerance_mps);
  EXPECT_LT(field.u(4, 0), 0.0);  // back around the fan
}

TEST(ProjectionTest, RejectsAirThatHasNowhereToGo) {
  FlowDomain domain = ClosedRoom(3, 3);
  domain.openings = {{{0, 1}, Side::kWest, 1.0}};
  EXPECT_EQ(Projection::Create(domain, FreeFaces(domain)).status().code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace projection_test
}  // namespace plumescout::lab
