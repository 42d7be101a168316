// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// The tours of [LHR]: surveys by an integer program, (P1), and the best subset of cells, (P2). Each
// in CPU time and as the part of its bar that it takes.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/tour/closed_tour.h"
#include "core/tour/subset_tour.h"
#include "core/types/quantile.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/worlds/tour_cases.h"

namespace plumescout::lab {
namespace {

constexpr int kRepeats = 9;

absl::Status MeasureSurvey(const std::string& name, const TourGraph& graph, BenchSummary& summary) {
  constexpr double kBar_ms = 1000.0;
  absl::StatusOr<ClosedTour> tour;
  const double cpu_ms = MedianCpu_ms(kRepeats, [&] { tour = ShortestClosedTour(graph); });
  PLUMESCOUT_RETURN_IF_ERROR(tour.status());
  summary.Set(absl::StrCat("survey_", name, "_ms"), cpu_ms);
  summary.Set(absl::StrCat("survey_", name, "_length_m"), tour->length_m);
  summary.Set(absl::StrCat("survey_", name, "_of_bar"), cpu_ms / kBar_ms);
  return absl::OkStatus();
}

// Meshes as in [LHR], whole and without one of their points.
absl::Status BenchSurveys(BenchSummary& summary) {
  for (const int side : {6, 8, 10}) {
    std::vector<Cell> points = LatticePoints(side, side);
    const std::string name = absl::StrCat(side, "x", side);
    PLUMESCOUT_RETURN_IF_ERROR(MeasureSurvey(name, MeshGraph(points, kSurveySpacing_m), summary));
    points.erase(points.begin() + side + 1);
    PLUMESCOUT_RETURN_IF_ERROR(
        MeasureSurvey(name + "_gap", MeshGraph(points, kSurveySpacing_m), summary));
  }
  return absl::OkStatus();
}

TourGraph AllPairs(const std::vector<Point2>& places) {
  TourGraph graph{static_cast<int>(places.size()), {}};
  for (int a = 0; a < graph.nodes; ++a) {
    for (int b = a + 1; b < graph.nodes; ++b) {
      graph.edges.push_back(
          {a, b,
           Distance_m(places[static_cast<std::size_t>(a)], places[static_cast<std::size_t>(b)])});
    }
  }
  return graph;
}

// Ways between all pairs of random places, as there are around obstacles.
absl::Status BenchAllPairs(BenchSummary& summary) {
  constexpr int kCases = 20;
  Rng rng(summary.seed());
  for (const int count : {36, 64}) {
    std::vector<double> times_ms;
    for (int i = 0; i < kCases; ++i) {
      const TourGraph graph = AllPairs(RandomTourPlaces(count, rng));
      const double begin_ms = ThreadCpu_ms();
      PLUMESCOUT_RETURN_IF_ERROR(ShortestClosedTour(graph).status());
      times_ms.push_back(ThreadCpu_ms() - begin_ms);
    }
    summary.Set(absl::StrCat("survey_all_pairs_", count, "_ms"), Median(times_ms));
    summary.Set(absl::StrCat("survey_all_pairs_", count, "_worst_ms"),
                *std::max_element(times_ms.begin(), times_ms.end()));
  }
  return absl::OkStatus();
}

// [LHR] IV-A: T = 10 of M; and if the cycle is too short for any cell, so
// that every smaller size is tried too.
absl::Status BenchSubsets(BenchSummary& summary) {
  constexpr double kBar_ms = 20.0;
  constexpr double kTooShort_s = 1.0;
  for (const int cells : {15, kMaxTourCells}) {
    Rng rng(summary.seed());
    const SubsetTourCase random = RandomSubsetTourCase(cells, rng);
    SubsetTourProblem problem = random.Problem();
    absl::StatusOr<SubsetTour> tour;
    const auto run = [&] { tour = BestSubsetTour(problem); };
    const std::string name = absl::StrCat("subsets_", problem.wanted, "_of_", cells);
    const double cpu_ms = MedianCpu_ms(kRepeats, run);
    PLUMESCOUT_RETURN_IF_ERROR(tour.status());
    summary.Set(name + "_ms", cpu_ms);
    summary.Set(name + "_of_bar", cpu_ms / kBar_ms);
    summary.Set(name + "_feasible", tour->feasible_subsets);
    problem.cycle_s = kTooShort_s;
    summary.Set(name + "_none_feasible_ms", MedianCpu_ms(kRepeats, run));
    PLUMESCOUT_RETURN_IF_ERROR(tour.status());
  }
  return absl::OkStatus();
}

absl::Status Run(BenchSummary& summary) {
  PLUMESCOUT_RETURN_IF_ERROR(BenchSubsets(summary));
  PLUMESCOUT_RETURN_IF_ERROR(BenchSurveys(summary));
  return BenchAllPairs(summary);
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  return plumescout::lab::BenchProgram("What survey tours and subsets of cells cost")
      .Run(argc, argv, plumescout::lab::Run);
}
