// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/belief_propagation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/gas/dense_field.h"
#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace belief_propagation_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;
using ::plumescout::testing::GridFromArt;

constexpr BeliefPropagationOptions kFine{.threshold = 1e-12};

Evidence EvidenceOf(const DenseReading& reading, const GasOptions& options) {
  return {reading.precision,
          reading.precision * (reading.concentration_ppm - options.background_mean_ppm)};
}

// A field, the propagation over it with all evidence set, and the exact solution.
struct Case {
  Case(const Grid<CellState>& states, const std::vector<DenseReading>& all_readings,
       const GasOptions& gas, const BeliefPropagationOptions& propagation)
      : readings(all_readings),
        options(gas),
        graph(states),
        exact(states, readings, options),
        solver(graph, options, propagation) {
    std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
    for (const DenseReading& r : readings) {
      evidence[ToSize(graph.At(r.cell))] += EvidenceOf(r, options);
    }
    for (int i = 0; i < graph.variables(); ++i) {
      solver.SetEvidence(static_cast<VariableIndex>(i), evidence[static_cast<std::size_t>(i)]);
    }
  }

  double MaxMeanError_ppm() const {
    const Posterior beliefs = solver.Beliefs();
    double error_ppm = 0.0;
    for (std::size_t i = 0; i < beliefs.mean_ppm.size(); ++i) {
      const double exact_ppm = exact.mean_ppm()(static_cast<Eigen::Index>(i));
      error_ppm = std::max(error_ppm, std::abs(beliefs.mean_ppm[i] - exact_ppm));
    }
    return error_ppm;
  }
  // Of the variance over the exact one, ascending.
  std::vector<double> VarianceRatios() const {
    const Posterior beliefs = solver.Beliefs();
    std::vector<double> ratios;
    for (std::size_t i = 0; i < beliefs.variance_ppm2.size(); ++i) {
      ratios.push_back(beliefs.variance_ppm2[i] /
                       exact.variance_ppm2()(static_cast<Eigen::Index>(i)));
    }
    std::sort(ratios.begin(), ratios.end());
    return ratios;
  }

  std::vector<DenseReading> readings;
  GasOptions options;
  GmrfGraph graph;
  DenseField exact;
  BeliefPropagation solver;
};

Case RandomCase(const BeliefPropagationOptions& propagation, std::uint64_t seed = 1) {
  Rng rng(seed);
  const Grid<CellState> states = testing::RandomStates(16, 14, 0.15, rng);
  const std::vector<DenseReading> readings = testing::RandomReadings(states, 30, rng);
  GasOptions gas;
  gas.background_mean_ppm = 2.0;
  gas.background_precision_per_ppm2 = 0.01;
  return {states, readings, gas, propagation};
}

TEST(BeliefPropagation, IsExactWithoutLoops) {
  const Grid<CellState> states = GridFromArt({"#.#....",  //
                                              "#.#.###",  //
                                              "....#.#"});
  Case c(states, {{{0, 0}, 10.0, 5.0}, {{3, 1}, 2.0, 40.0}}, GasOptions{}, kFine);
  c.solver.Propagate();
  EXPECT_LT(c.MaxMeanError_ppm(), 1e-8);
  EXPECT_NEAR(c.VarianceRatios().front(), 1.0, 1e-9);
  EXPECT_NEAR(c.VarianceRatios().back(), 1.0, 1e-9);
}

class Schedules : public ::testing::TestWithParam<MessageSchedule> {};

TEST_P(Schedules, ConvergeToTheExactMeanAndToTooSmallAVariance) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Case c = RandomCase({.schedule = GetParam(), .threshold = 1e-12}, seed);
    c.solver.Propagate();
    EXPECT_TRUE(c.solver.converged());
    EXPECT_LT(c.MaxMeanError_ppm(), 1e-6);
    const std::vector<double> ratios = c.VarianceRatios();
    EXPECT_LE(ratios.back(), 1.0 + 1e-9);
    EXPECT_GT(ratios.front(), 0.1);
    EXPECT_LT(ratios[ratios.size() / 2], 0.95);
  }
}

TEST_P(Schedules, FollowEvidenceToWhereAFreshStartGets) {
  Case fresh = RandomCase({.schedule = GetParam(), .threshold = 1e-12});
  fresh.solver.Propagate();
  BeliefPropagation grown(fresh.graph, fresh.options, {.schedule = GetParam(), .threshold = 1e-12});
  std::vector<Evidence> evidence(static_cast<std::size_t>(fresh.graph.variables()));
  for (const DenseReading& r : fresh.readings) {
    const VariableIndex variable = fresh.graph.At(r.cell);
    evidence[ToSize(variable)] += EvidenceOf(r, fresh.options);
    grown.SetEvidence(variable, evidence[ToSize(variable)]);
    grown.Propagate();
  }
  const Posterior a = fresh.solver.Beliefs();
  const Posterior b = grown.Beliefs();
  for (std::size_t i = 0; i < a.mean_ppm.size(); ++i) {
    EXPECT_NEAR(a.mean_ppm[i], b.mean_ppm[i], 1e-6);
    EXPECT_NEAR(a.variance_ppm2[i], b.variance_ppm2[i], 1e-9);
  }
}

TEST_P(Schedules, SpreadANewReadingOnlyAsFarAsTheThresholdSays) {
  Rng rng(1);
  const Grid<CellState> states = testing::RandomStates(30, 30, 0.0, rng);
  const GmrfGraph graph(states);
  std::vector<std::int64_t> sends;
  for (const double threshold : {1.0, 1e-1, 1e-2}) {
    BeliefPropagation solver(graph, GasOptions{}, {.schedule = GetParam(), .threshold = threshold});
    solver.Propagate();
    solver.SetEvidence(graph.At({15, 15}), {10.0, 100.0});
    sends.push_back(solver.Propagate());
  }
  EXPECT_LT(sends[0], sends[1]);
  EXPECT_LT(sends[1], sends[2]);
  EXPECT_LT(sends[0], 200);
}

TEST_P(Schedules, StopWhereToldAndGoOnFromThere) {
  Case whole = RandomCase({.schedule = GetParam(), .threshold = 1e-6});
  Case parts = RandomCase({.schedule = GetParam(), .threshold = 1e-6});
  const std::int64_t sends = whole.solver.Propagate();
  EXPECT_EQ(parts.solver.Propagate(10), 10);
  EXPECT_FALSE(parts.solver.converged());
  EXPECT_EQ(parts.solver.Propagate(), sends - 10);
  EXPECT_EQ(parts.solver.Beliefs().mean_ppm, whole.solver.Beliefs().mean_ppm);
}

TEST_P(Schedules, KnowTheBhattacharyyaDistance) {
  Case c = RandomCase(
      {.schedule = GetParam(), .distance = MessageDistance::kBhattacharyya, .threshold = 1e-20});
  c.solver.Propagate();
  EXPECT_LT(c.MaxMeanError_ppm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(BeliefPropagation, Schedules,
                         ::testing::Values(MessageSchedule::kWildfire, MessageSchedule::kResidual),
                         [](const auto& info) {
                           return info.param == MessageSchedule::kWildfire ? "Wildfire"
                                                                           : "Residual";
                         });

TEST(BeliefPropagation, OfNothingIsNothing) {
  const GmrfGraph graph(GridFromArt({"##", "##"}));
  BeliefPropagation solver(graph, GasOptions{}, {});
  EXPECT_EQ(solver.Propagate(), 0);
  EXPECT_TRUE(solver.Beliefs().mean_ppm.empty());
}

TEST(BeliefPropagation, OfAnIsolatedCellIsItsOwnEvidence) {
  const GmrfGraph graph(GridFromArt({"#.#"}));
  const GasOptions options;
  BeliefPropagation solver(graph, options, {});
  solver.SetEvidence(graph.At({1, 0}), {10.0, 50.0});
  solver.Propagate();
  const double precision = 10.0 + options.background_precision_per_ppm2;
  EXPECT_NEAR(solver.Beliefs().mean_ppm[0], 50.0 / precision, 1e-12);
  EXPECT_NEAR(solver.Beliefs().variance_ppm2[0], 1.0 / precision, 1e-12);
}

}  // namespace belief_propagation_test
}  // namespace plumescout::lab
