// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/tour_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "tests/core/tour/tour_case.h"

namespace plumescout {
namespace tour_program_test {

using testing::ElementsAre;

constexpr double kSolver_m = 1e-6;  // the solver's 1e-7 of the longest edge, 2 m, for a few nodes

double Cost_m(const TourGraph& graph, const std::vector<double>& x) {
  double cost_m = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) cost_m += x[i] * graph.edges[i].cost_m;
  return cost_m;
}

// A prism with longer links, so that its two triangles are cheapest.
TourGraph LongPrism() {
  TourGraph graph = Prism();
  for (std::size_t i = 6; i < graph.edges.size(); ++i) graph.edges[i].cost_m = 10.0;
  return graph;
}

TEST(TourProgram, WithoutSubtourConstraintsTheCheapestSubtoursWin) {
  TourProgram program(LongPrism());
  const auto x = program.Solve(NeverStop());
  ASSERT_TRUE(x.ok()) << x.status();
  EXPECT_THAT(*x, ElementsAre(1, 1, 1, 1, 1, 1, 0, 0, 0));
}

TEST(TourProgram, AForbiddenSubtourIsLeft) {
  const TourGraph graph = LongPrism();
  TourProgram program(graph);
  program.ForbidSubtour({0, 1, 2});
  const auto x = program.Solve(NeverStop());
  ASSERT_TRUE(x.ok()) << x.status();
  EXPECT_NEAR(Cost_m(graph, *x), 4 * 2.0 + 2 * 10.0, kSolver_m);
}

TEST(TourProgram, EdgesTakenInPartAreCheaperThanWholeOnes) {
  // Half of each triangle's edges and all links: 6 * 2 / 2 + 3 * 1. Whole edges: 4 * 2 + 2 * 1.
  TourProgram program(Prism());
  const auto relaxed = program.SolveRelaxed();
  ASSERT_TRUE(relaxed.ok()) << relaxed.status();
  EXPECT_NEAR(Cost_m(Prism(), *relaxed), 9.0, kSolver_m);
  const auto whole = program.Solve(NeverStop());
  ASSERT_TRUE(whole.ok()) << whole.status();
  EXPECT_NEAR(Cost_m(Prism(), *whole), 10.0, kSolver_m);
}

TEST(TourProgram, ASolutionIsFoundAgainAfterAnother) {
  TourProgram program(Prism());
  const auto first = program.Solve(NeverStop());
  ASSERT_TRUE(program.SolveRelaxed().ok());
  const auto second = program.Solve(NeverStop());
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(Cost_m(Prism(), *first), Cost_m(Prism(), *second));
}

TEST(TourProgram, WhatCannotBeFulfilledIsNotFound) {
  const TourGraph star = {4, {{0, 1, 1.0}, {0, 2, 1.0}, {0, 3, 1.0}}};
  EXPECT_EQ(TourProgram(star).SolveRelaxed().status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(TourProgram(star).Solve(NeverStop()).status().code(), absl::StatusCode::kNotFound);
}

TEST(TourProgram, AGraphWithoutEdgesHasNoSolution) {
  const TourGraph points = {3, {}};
  EXPECT_EQ(TourProgram(points).SolveRelaxed().status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(TourProgram(points).Solve(NeverStop()).status().code(), absl::StatusCode::kNotFound);
}

TEST(TourProgram, ASearchThatIsStoppedSaysSo) {
  TourProgram program(RandomGraph(50, 1.0, 1));
  EXPECT_EQ(program.Solve([] { return true; }).status().code(),
            absl::StatusCode::kDeadlineExceeded);
}

}  // namespace tour_program_test
}  // namespace plumescout
