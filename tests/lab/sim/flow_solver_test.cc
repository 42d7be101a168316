// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/flow_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/lab/sim/flow_domains.h"

namespace plumescout::lab {
namespace flow_solver_test {

constexpr double kViscosity_m2_per_s = 0.01;

// A channel with a box in it and a lid that slides: everything that drives or hinders air.
FlowDomain Obstructed() {
  FlowDomain domain = Channel(24, 9, 0.3);
  for (int y = 0; y < 4; ++y) domain.fluid[Cell(8, y)] = 0;
  domain.edge_speeds_mps[static_cast<std::size_t>(Side::kNorth)] = 0.5;
  return domain;
}

MacField After(double time_s, double share) {
  auto solver = FlowSolver::Create(Obstructed(), kViscosity_m2_per_s);
  EXPECT_TRUE(solver.ok()) << solver.status();
  double left_s = time_s;
  while (left_s > 0.0) {
    const double step_s = std::min(left_s, share * solver->StableStep_s());
    EXPECT_TRUE(solver->Step(step_s).ok());
    left_s -= step_s;
  }
  return solver->velocity();
}

double Apart(const MacField& a, MacField b) {
  b.AddScaled(a, -1.0);
  return std::max(b.MaxMagnitudes().u_mps, b.MaxMagnitudes().v_mps);
}

// No circulation around any corner of four fluid cells.
TEST(FlowSolverTest, BeginsWithPotentialFlow) {
  const FlowDomain domain = Obstructed();
  const auto solver = FlowSolver::Create(domain, kViscosity_m2_per_s);
  ASSERT_TRUE(solver.ok()) << solver.status();
  const MacField& f = solver->velocity();
  const auto fluid = [&](int x, int y) { return domain.fluid[Cell{x, y}] != 0; };
  for (int y = 1; y < 9; ++y) {
    for (int x = 1; x < 24; ++x) {
      if (!fluid(x, y) || !fluid(x - 1, y) || !fluid(x, y - 1) || !fluid(x - 1, y - 1)) continue;
      EXPECT_NEAR(f.v(x, y) - f.v(x - 1, y), f.u(x, y) - f.u(x, y - 1), 1e-12) << x << ", " << y;
    }
  }
  EXPECT_LT(WorstNetOutflow_mps(domain, f), 1e-12);
}

TEST(FlowSolverTest, HasASteadyStateThatDoesNotDependOnTheStep) {
  // Ten times the diffusion time across the channel, (0.9 m / pi)^2 / nu = 8 s.
  EXPECT_LT(Apart(After(80.0, 0.9), After(80.0, 0.4)), 1e-4);
}

// Halving the step divides the error by four; that against half the step is three quarters and
// three sixteenths of it. The limiter's switches and the changing step leave an order of some 1.6.
TEST(FlowSolverTest, IsMoreThanFirstOrderInTime) {
  const MacField fine = After(1.0, 0.05);
  const double coarse_error = Apart(fine, After(1.0, 0.8));
  const double middle_error = Apart(fine, After(1.0, 0.4));
  EXPECT_GT(coarse_error / middle_error, 3.0);
}

TEST(FlowSolverTest, StaysDivergenceFree) {
  EXPECT_LT(WorstNetOutflow_mps(Obstructed(), After(2.0, 0.9)), 1e-12);
}

// Two orders below any turbulent viscosity, so that only the limiter is there to keep it stable.
TEST(FlowSolverTest, StaysBoundedWithHardlyAnyViscosity) {
  auto solver = FlowSolver::Create(Obstructed(), 1e-4);
  ASSERT_TRUE(solver.ok());
  for (int i = 0; i < 2000; ++i) ASSERT_TRUE(solver->Step(0.9 * solver->StableStep_s()).ok());
  EXPECT_LT(solver->velocity().FastestCell_mps(), 5.0);  // the gap alone makes 0.54 of 0.3 m/s
}

}  // namespace flow_solver_test
}  // namespace plumescout::lab
