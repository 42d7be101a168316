// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/edge_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/grid/neighbours.h"
#include "core/types/rng.h"
#include "tests/support/plan_map.h"

namespace plumescout {
namespace edge_cost_test {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;  // hundreds of additions of values of order 1

InformationMap InformationOf(const Grid<float>& penalty) {
  InformationMap information;
  information.penalty = penalty;
  information.min_penalty = 0.1F;
  return information;
}

// Three cells of 0.1 m in a row.
Grid<float> ThreeCells(float a, float b, float c) {
  Grid<float> penalty(GridGeometry{0.0, 0.0, 0.1, 3, 1});
  penalty.values() = {a, b, c};
  return penalty;
}

struct RandomCase {
  explicit RandomCase(std::uint64_t seed)
      : rng(seed),
        open(testing::RandomObstacles(40, 30, 8, rng)),
        information(testing::WavyInformation(open, rng)) {}

  Point2 Point() {
    const GridGeometry& g = open.geometry();
    return {g.origin_x_m + rng.Uniform(0.0, g.width * g.resolution_m),
            g.origin_y_m + rng.Uniform(0.0, g.height * g.resolution_m)};
  }

  Rng rng;
  Grid<std::uint8_t> open;
  InformationMap information;
};

TEST(EdgeCost, AtVerticesTakesTheEndsPenaltyAlone) {
  const InformationMap information = InformationOf(ThreeCells(0.9F, 0.5F, 0.25F));
  const EdgeCost cost(information, CostKind::kVertices, 2.0);
  EXPECT_NEAR(cost({0.05, 0.05}, {0.25, 0.05}), 0.25 + 2.0 * 0.2, 1e-6);
  EXPECT_NEAR(cost({0.25, 0.05}, {0.05, 0.05}), 0.9 + 2.0 * 0.2, 1e-6);
  EXPECT_NEAR(cost.GridStep(0.9F, 0.5F, 1.0), cost({0.05, 0.05}, {0.15, 0.05}), 1e-6);
  EXPECT_LE(cost.LowerBound(0.2), cost({0.05, 0.05}, {0.25, 0.05}));
}

TEST(EdgeCost, AtVerticesStillHitsWhatStandsBetween) {
  const InformationMap information = InformationOf(ThreeCells(0.9F, kInf, 0.25F));
  EXPECT_EQ(EdgeCost(information, CostKind::kVertices, 0.0)({0.05, 0.05}, {0.25, 0.05}), kInf);
}

TEST(EdgeCost, InformedHeuristicPricesTheStraightLineThroughObstacles) {
  const InformationMap information = InformationOf(ThreeCells(0.5F, kInf, 0.25F));
  const EdgeCost cost(information, CostKind::kUcb, 2.0);
  // Half a cell at 0.5, one blocked at the greatest penalty, half a cell at 0.25.
  EXPECT_NEAR(cost.InformedHeuristic({0.05, 0.05}, {0.25, 0.05}),
              0.5 * 0.5 + 1.0 + 0.5 * 0.25 + 2.0 * 0.2, 1e-6);
  EXPECT_NEAR(EdgeCost(information, CostKind::kEuclidean, 0.0)
                  .InformedHeuristic({0.05, 0.05}, {0.25, 0.05}),
              0.2, kRounding);
}

TEST(SegmentIntegral, WeighsEachCellByTheLengthInside) {
  // From the middle of the first cell to a quarter into the third.
  EXPECT_NEAR(SegmentIntegral_cells(ThreeCells(1.0F, 0.5F, 0.25F), {0.05, 0.05}, {0.225, 0.05}),
              0.5 * 1.0 + 1.0 * 0.5 + 0.25 * 0.25, kRounding);
}

TEST(SegmentIntegral, EqualsDenseSampling) {
  RandomCase c(1);
  int finite = 0;
  for (int i = 0; i < 300; ++i) {
    const Point2 a = c.Point();
    const Point2 b = c.Point();
    const double exact = SegmentIntegral_cells(c.information.penalty, a, b);
    constexpr int kPoints = 20'000;
    const std::vector<float> values = testing::ValuesAlong(c.information.penalty, a, b, kPoints);
    double sum = 0.0;
    for (const float value : values) sum += value;
    const double length_cells = Distance_m(a, b) / c.open.geometry().resolution_m;
    if (!std::isfinite(sum)) {
      EXPECT_EQ(exact, kInf);
      continue;
    }
    // Sampling errs by at most a spacing at each of the cell edges crossed, by values up to 1.
    const double spacing_cells = length_cells / kPoints;
    const double edges = 2.0 * length_cells + 2.0;
    if (exact < kInf) {
      ++finite;
      EXPECT_NEAR(exact, sum / static_cast<double>(values.size()) * length_cells,
                  spacing_cells * edges);
    }
  }
  EXPECT_GT(finite, 50);
}

TEST(SegmentIntegral, AddsUpUnderSubdivisionAndIsTheSameBothWays) {
  RandomCase c(2);
  for (int i = 0; i < 500; ++i) {
    const Point2 a = c.Point();
    const Point2 b = c.Point();
    const double t = c.rng.Uniform01();
    const Point2 middle{a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m)};
    const double whole = SegmentIntegral_cells(c.information.penalty, a, b);
    const double back = SegmentIntegral_cells(c.information.penalty, b, a);
    const double parts = SegmentIntegral_cells(c.information.penalty, a, middle) +
                         SegmentIntegral_cells(c.information.penalty, middle, b);
    if (whole == kInf) {
      EXPECT_EQ(back, kInf);
      EXPECT_EQ(parts, kInf);
    } else {
      EXPECT_NEAR(whole, back, kRounding);
      EXPECT_NEAR(whole, parts, kRounding);
    }
  }
}

TEST(SegmentIntegral, IsInfiniteThroughABlockedCellHoweverShortTheCut) {
  const auto blocked = std::numeric_limits<float>::infinity();
  Grid<float> penalty(GridGeometry{0.0, 0.0, 0.1, 2, 2}, 1.0F);
  penalty[Cell{1, 0}] = blocked;
  EXPECT_EQ(SegmentIntegral_cells(penalty, {0.05, 0.05}, {0.15, 0.15}), kInf) << "corner";
  EXPECT_EQ(SegmentIntegral_cells(penalty, {0.15, 0.15}, {0.05, 0.05}), kInf) << "and back";
  EXPECT_EQ(SegmentIntegral_cells(penalty, {0.05, 0.049}, {0.15, 0.15}), kInf);
  EXPECT_LT(SegmentIntegral_cells(penalty, {0.05, 0.051}, {0.149, 0.15}), kInf);
}

TEST(SegmentIntegral, IsInfiniteOutsideTheMap) {
  EXPECT_EQ(SegmentIntegral_cells(ThreeCells(1, 1, 1), {0.05, 0.05}, {0.35, 0.05}), kInf);
  EXPECT_EQ(SegmentIntegral_cells(ThreeCells(1, 1, 1), {-0.05, 0.05}, {0.05, 0.05}), kInf);
  EXPECT_EQ(SegmentIntegral_cells(Grid<float>(), {0.0, 0.0}, {0.1, 0.0}), kInf);
}

TEST(SegmentIntegral, OfAPointIsZeroInsideAndInfiniteInABlockedCell) {
  const auto blocked = std::numeric_limits<float>::infinity();
  EXPECT_EQ(SegmentIntegral_cells(ThreeCells(1, 1, 1), {0.05, 0.05}, {0.05, 0.05}), 0.0);
  EXPECT_EQ(SegmentIntegral_cells(ThreeCells(blocked, 1, 1), {0.05, 0.05}, {0.05, 0.05}), kInf);
}

TEST(EdgeCost, IsPenaltyInCellsPlusAlphaPerMetre) {  // Eq. (12)
  const InformationMap information = InformationOf(ThreeCells(1.0F, 0.5F, 0.25F));
  const Point2 a{0.05, 0.05};
  const Point2 b{0.25, 0.05};
  EXPECT_NEAR(EdgeCost(information, CostKind::kUcb, 0.0)(a, b), 0.5 + 0.5 + 0.125, kRounding);
  EXPECT_NEAR(EdgeCost(information, CostKind::kUcb, 3.0)(a, b), 1.125 + 3.0 * 0.2, kRounding);
}

TEST(EdgeCost, EuclideanIsTheLengthWhateverAlpha) {
  const InformationMap information = InformationOf(ThreeCells(1.0F, 0.5F, 0.25F));
  EXPECT_NEAR(EdgeCost(information, CostKind::kEuclidean, 7.0)({0.05, 0.05}, {0.25, 0.05}), 0.2,
              kRounding);
}

TEST(EdgeCost, IsInfiniteThroughBlockedCellsForEveryKind) {
  const InformationMap information =
      InformationOf(ThreeCells(1.0F, std::numeric_limits<float>::infinity(), 1.0F));
  for (const CostKind kind : {CostKind::kUcb, CostKind::kEuclidean}) {
    EXPECT_EQ(EdgeCost(information, kind, 1.0)({0.05, 0.05}, {0.25, 0.05}), kInf);
  }
}

TEST(EdgeCost, NeverGoesBelowItsLowerBoundAndTheHeuristicIsConsistent) {
  RandomCase c(3);
  for (const CostKind kind : {CostKind::kUcb, CostKind::kEuclidean}) {
    const EdgeCost cost(c.information, kind, 0.7);
    for (int i = 0; i < 500; ++i) {
      const Point2 a = c.Point();
      const Point2 b = c.Point();
      const Point2 goal = c.Point();
      EXPECT_GE(cost(a, b), cost.LowerBound(Distance_m(a, b)) - kRounding);  // Eq. (6)
      EXPECT_LE(cost.Heuristic(Distance_m(a, goal)),
                cost(a, b) + cost.Heuristic(Distance_m(b, goal)) + kRounding);
    }
  }
}

TEST(EdgeCost, UpToALimitIsThePriceIfItIsLess) {
  RandomCase c(5);
  for (const CostKind kind : {CostKind::kUcb, CostKind::kEuclidean, CostKind::kVertices}) {
    const EdgeCost cost(c.information, kind, 0.7);
    int below = 0;
    for (int i = 0; i < 500; ++i) {
      const Point2 a = c.Point();
      const Point2 b = c.Point();
      const double limit = c.rng.Uniform(0.0, 40.0);
      const double price = cost(a, b);
      below += price < limit ? 1 : 0;
      if (price < limit) {
        EXPECT_EQ(cost.UpTo(a, b, limit), price);
      } else {
        EXPECT_GE(cost.UpTo(a, b, limit), limit);
      }
      EXPECT_EQ(cost.UpTo(a, b, kInf), price);
    }
    EXPECT_GT(below, 20);
    EXPECT_LT(below, 480);
  }
}

TEST(EdgeCost, HasAHeuristicOnlyIfLengthCosts) {
  const InformationMap information = InformationOf(ThreeCells(1, 1, 1));
  EXPECT_FALSE(EdgeCost(information, CostKind::kUcb, 0.0).HasHeuristic());
  EXPECT_TRUE(EdgeCost(information, CostKind::kUcb, 0.1).HasHeuristic());
  EXPECT_TRUE(EdgeCost(information, CostKind::kEuclidean, 0.0).HasHeuristic());
}

TEST(EdgeCost, OfAGridStepIsThatOfTheSegment) {
  RandomCase c(4);
  for (const CostKind kind : {CostKind::kUcb, CostKind::kEuclidean}) {
    const EdgeCost cost(c.information, kind, 0.3);
    for (int i = 0; i < 200; ++i) {
      const Cell from = testing::RandomOpenCell(c.open, c.rng);
      const Cell offset = kNeighbours8[c.rng.Below(8)];
      const Cell to = Shifted(from, offset);
      const double walked = cost(c.open.geometry().Center(from), c.open.geometry().Center(to));
      if (walked == kInf) continue;
      EXPECT_NEAR(cost.GridStep(c.information.penalty[from], c.information.penalty[to],
                                StepLength_cells(offset)),
                  walked, kRounding);
    }
  }
}

TEST(PathCost, IsTheSumOverTheSegments) {  // Eq. (13)
  const InformationMap information = InformationOf(ThreeCells(1.0F, 0.5F, 0.25F));
  const EdgeCost cost(information, CostKind::kUcb, 1.0);
  const Point2 a{0.05, 0.05};
  const Point2 b{0.12, 0.08};
  const Point2 c{0.25, 0.02};
  EXPECT_EQ(PathCost(cost, {a, b, c}), cost(a, b) + cost(b, c));
  EXPECT_EQ(PathCost(cost, {a}), 0.0);
  EXPECT_EQ(PathCost(cost, {}), 0.0);
}

}  // namespace edge_cost_test
}  // namespace plumescout
