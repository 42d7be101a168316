// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/survey.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/sampling/ways.h"
#include "core/tour/closed_tour.h"
#include "core/tour/tour_graph.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Where a site stands among those of the survey, if it is one.
std::optional<Cell> SurveyCell(const Site& site, const SiteLattice& lattice, int stride) {
  const auto width = static_cast<std::size_t>(lattice.columns);
  const int column = static_cast<int>(site.index % width);
  const int row = static_cast<int>(site.index / width);
  if (column % stride != 0 || row % stride != 0) return std::nullopt;
  return Cell{column / stride, row / stride};
}

struct SurveySites {
  std::vector<Site> sites;
  std::vector<Cell> cells;  // of the mesh
};

SurveySites FindSurveySites(const SamplingQuery& query) {
  SurveySites found;
  for (const Site& site : query.sites.offered) {
    const auto cell =
        SurveyCell(site, query.sites.lattice, query.robot.options.sites.survey_stride);
    if (!cell) continue;
    found.sites.push_back(site);
    found.cells.push_back(*cell);
  }
  return found;
}

// Prices the edges by the ways there are; those without one go.
TourGraph Driven(TourGraph graph, const std::vector<Site>& sites,
                 const Grid<std::uint8_t>& reachable) {
  std::vector<std::vector<TourEdge>> by_first(sites.size());
  for (const TourEdge& edge : graph.edges) {
    by_first[static_cast<std::size_t>(edge.a)].push_back(edge);
  }
  graph.edges.clear();
  for (std::size_t a = 0; a < sites.size(); ++a) {
    std::vector<Point2> ends;
    for (const TourEdge& edge : by_first[a]) {
      ends.push_back(sites[static_cast<std::size_t>(edge.b)].place);
    }
    const std::vector<Way> ways = WaysFrom(reachable, sites[a].place, ends);
    for (std::size_t k = 0; k < ways.size(); ++k) {
      if (ways[k].vertices.empty()) continue;
      by_first[a][k].cost_m = ways[k].length_m;
      graph.edges.push_back(by_first[a][k]);
    }
  }
  return graph;
}

TourGraph Complete(std::size_t nodes) {
  TourGraph graph{static_cast<int>(nodes), {}};
  for (int a = 0; a < graph.nodes; ++a) {
    for (int b = a + 1; b < graph.nodes; ++b) graph.edges.push_back({a, b, 0.0});
  }
  return graph;
}

absl::StatusOr<std::vector<int>> TourOf(const SamplingQuery& query, const SurveySites& survey) {
  const double spacing_m = query.robot.options.sites.survey_stride * query.sites.lattice.spacing_m;
  const Grid<std::uint8_t>& reachable = query.robot.reachable;
  auto tour = ShortestClosedTour(
      Driven(MeshGraph(survey.cells, spacing_m), survey.sites, reachable), query.stop);
  if (absl::IsNotFound(tour.status())) {
    tour = ShortestClosedTour(Driven(Complete(survey.sites.size()), survey.sites, reachable),
                              query.stop);
  }
  PLUMESCOUT_RETURN_IF_ERROR(tour.status());
  return std::move(tour->order);
}

// The cyclic order `stops` as the shortest open drive from the robot: the way to its first stop,
// and every leg but the one between its last and its first. Of equal ones the site that comes first
// in the lattice begins.
std::vector<Site> FromTheRobot(const Grid<std::uint8_t>& reachable, std::vector<Site> stops) {
  const std::size_t count = stops.size();
  std::vector<double> leg_m;  // from each to the next
  for (std::size_t i = 0; i < count; ++i) {
    leg_m.push_back(
        WaysFrom(reachable, stops[i].place, {stops[(i + 1) % count].place}).front().length_m);
  }
  std::size_t first = 0;
  bool backwards = false;
  double least_m = std::numeric_limits<double>::infinity();
  const auto consider = [&](std::size_t i, bool back, double undriven_m) {
    constexpr double kRounding_m = 1e-9;
    const double drive_m = stops[i].travel_m - undriven_m;
    const bool is_less = drive_m < least_m - kRounding_m;
    const bool is_tie = drive_m <= least_m + kRounding_m && stops[i].index < stops[first].index;
    if (!is_less && !is_tie) return;
    least_m = drive_m;
    first = i;
    backwards = back;
  };
  for (std::size_t i = 0; i < count; ++i) {
    consider(i, /*back=*/false, leg_m[(i + count - 1) % count]);
    consider(i, /*back=*/true, leg_m[i]);
  }
  std::rotate(stops.begin(), stops.begin() + static_cast<std::ptrdiff_t>(first), stops.end());
  if (backwards) std::reverse(stops.begin() + 1, stops.end());
  return stops;
}

}  // namespace

absl::Status CheckSurvey(const SiteLattice& lattice, int stride) {
  const int columns = (lattice.columns - 1) / stride + 1;
  const int rows = (lattice.rows - 1) / stride + 1;
  if ((lattice.columns - 1) % stride != 0 || (lattice.rows - 1) % stride != 0) {
    return absl::InvalidArgumentError(absl::StrCat(
        "planning.sites.survey_stride = ", stride, " must divide the region: one less than its ",
        lattice.columns, " x ", lattice.rows, " sites each way"));
  }
  if (columns * rows <= kMaxSurveySites) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("planning.sites.survey_stride = ", stride,
                                                 " makes a survey of ", columns, " x ", rows,
                                                 " sites; must be at most ", kMaxSurveySites));
}

absl::StatusOr<std::vector<Site>> RestOfSurvey(const SamplingQuery& query) {
  const SurveySites survey = FindSurveySites(query);
  const auto is_left = [](const Site& site) { return !site.sampled; };
  if (std::none_of(survey.sites.begin(), survey.sites.end(), is_left)) return std::vector<Site>{};
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<int> order, TourOf(query, survey));
  std::vector<Site> stops;
  for (const int node : order) {
    const Site& site = survey.sites[static_cast<std::size_t>(node)];
    if (is_left(site)) stops.push_back(site);
  }
  return FromTheRobot(query.robot.reachable, std::move(stops));
}

}  // namespace plumescout
