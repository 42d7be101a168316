// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_fig3.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/plan/cost/edge_cost.h"
#include "core/plan/paths/path_planners.h"
#include "core/plan/paths/xit.h"
#include "lab/about/about.h"
#include "lab/report/palette.h"
#include "lab/worlds/grid_oracle.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPaperAlphas[] = {0.0, 0.005, 1.0};
constexpr int kLowestDecade = -3;
constexpr int kDecades = 6;
constexpr int kConnectivity = 32;
constexpr Stroke kTreeStroke{kSourceColor, 3.5};
constexpr Stroke kExactStroke{kInk, 1.8};

// A path and what it is judged by.
struct Way {
  std::vector<Point2> path;  // empty if none was found
  double length_m = kNan;
  double mean_information = kNan;
};

// The ways for one alpha: of XIT's tree, and the best there is.
struct WeighedWays {
  double alpha_per_m = 0.0;
  Way tree;
  Way exact;
};

std::vector<double> Alphas(bool quick) {
  std::vector<double> alphas(std::begin(kPaperAlphas), std::end(kPaperAlphas));
  const int per_decade = quick ? 2 : 10;
  for (int i = 0; i <= kDecades * per_decade; ++i) {
    alphas.push_back(std::pow(10.0, kLowestDecade + i / static_cast<double>(per_decade)));
  }
  std::sort(alphas.begin(), alphas.end());
  alphas.erase(std::unique(alphas.begin(), alphas.end()), alphas.end());
  return alphas;
}

Way WayOf(const PathResult& result, const SyntheticScene& scene) {
  Way way;
  if (!result.paths.front()) return way;
  way.path = result.paths.front()->vertices;
  way.length_m = PathLength_m(way.path);
  way.mean_information = MeanInformation(scene, way.path);
  return way;
}

WeighedWays Weigh(const SyntheticScene& scene, double alpha_per_m, std::uint64_t seed) {
  const PlanningOptions options;
  PlanningOptions exact_options;
  exact_options.paths = PathKind::kGridExact;
  const EdgeCost cost(scene.information, CostKind::kUcb, alpha_per_m);
  const std::vector<Goal> goals = {scene.goal};
  const StopFn stop = NeverStop();
  const PathProblem problem{cost, scene.reachable, scene.start, goals, seed, 0, stop};
  const auto exact = MakePathPlanner(exact_options, nullptr).value();
  return {alpha_per_m, WayOf(XitPlanner(options).FindPaths(problem), scene),
          WayOf(exact->FindPaths(problem), scene)};
}

double Shortest_m(const SyntheticScene& scene) {
  const EdgeCost length(scene.information, CostKind::kEuclidean, 0.0);
  const Cell start = scene.occupancy.geometry().CellAt(scene.start);
  return OracleCosts(length, start, kConnectivity)[scene.goal.cell];
}

// The least alpha at which half of the detour of alpha = 0 is gone, by the exact ways.
const WeighedWays& HalfWay(const std::vector<WeighedWays>& ways, double shortest_m) {
  const double detour_m = ways.front().exact.length_m - shortest_m;
  return *std::find_if(ways.begin(), ways.end() - 1, [&](const WeighedWays& w) {
    return w.exact.length_m - shortest_m <= 0.5 * detour_m;
  });
}

MapPanel MakePanel(const SyntheticScene& scene, const WeighedWays& ways, double shortest_m) {
  MapPanel panel = MakeScenePanel(scene);
  panel.title = absl::StrFormat("alpha = %.3g / m: %.2f x shortest", ways.alpha_per_m,
                                ways.tree.length_m / shortest_m);
  AddPath(ways.exact.path, kExactStroke, panel);
  AddPath(ways.tree.path, kTreeStroke, panel);
  panel.legend = {{"XIT, N = 300", MarkShape::kLine, kTreeStroke.color},
                  {"exact", MarkShape::kLine, kExactStroke.color},
                  {"start", MarkShape::kDisc, kStartColor},
                  {"goal", MarkShape::kDisc, kOccupancyFrontierColor}};
  return panel;
}

// One figure of both kinds of way over alpha. Alpha = 0 has no place on the axis.
template <typename Figure>
Chart MakeChart(const char* title, const std::vector<WeighedWays>& ways, Figure figure) {
  Curve tree{"XIT", {kTreeStroke.color, 2.0}, {}};
  Curve exact{"exact", {kExactStroke.color, 1.5, 5.0}, {}};
  for (const WeighedWays& w : ways) {
    if (!(w.alpha_per_m > 0.0)) continue;
    tree.points.push_back({std::log10(w.alpha_per_m), figure(w.tree)});
    exact.points.push_back({std::log10(w.alpha_per_m), figure(w.exact)});
  }
  return {title, "log10 of alpha in 1/m", std::nullopt, {tree, exact}};
}

CsvTable MakeTable(const std::vector<WeighedWays>& ways, double shortest_m) {
  CsvTable table{{"alpha_per_m", "xit_length_m", "xit_length_over_shortest", "xit_mean_information",
                  "exact_length_m", "exact_length_over_shortest", "exact_mean_information"},
                 {}};
  for (const WeighedWays& w : ways) {
    table.rows.push_back({w.alpha_per_m, w.tree.length_m, w.tree.length_m / shortest_m,
                          w.tree.mean_information, w.exact.length_m, w.exact.length_m / shortest_m,
                          w.exact.mean_information});
  }
  return table;
}

void AddFigures(const WeighedWays& ways, double shortest_m, const std::string& name, Study& study) {
  study.summary.figures.emplace_back(name + "_alpha_per_m", ways.alpha_per_m);
  for (const auto& [kind, way] : {std::pair("xit", &ways.tree), std::pair("exact", &ways.exact)}) {
    study.summary.figures.emplace_back(absl::StrCat(name, "_", kind, "_length_over_shortest"),
                                       way->length_m / shortest_m);
    study.summary.figures.emplace_back(absl::StrCat(name, "_", kind, "_mean_information"),
                                       way->mean_information);
  }
}

// The lengths of XIT's ways and where they change come first, in large print.
void AddKeyNumbers(const std::vector<WeighedWays>& shown, double shortest_m, Study& study) {
  auto& numbers = study.figures.key_numbers;
  const auto add = [&](const WeighedWays& w, const char* name, double value) {
    numbers.emplace_back(absl::StrFormat("alpha = %.3g: %s", w.alpha_per_m, name),
                         absl::StrFormat("%.3f", value));
  };
  for (const WeighedWays& w : shown) add(w, "XIT, length / shortest", w.tree.length_m / shortest_m);
  numbers.emplace_back("half of the detour is gone at alpha =",
                       absl::StrFormat("%.3g / m", shown.back().alpha_per_m));
  numbers.emplace_back("shortest way", absl::StrFormat("%.2f m", shortest_m));
  for (const WeighedWays& w : shown) add(w, "XIT, mean information", w.tree.mean_information);
  for (const WeighedWays& w : shown) {
    add(w, "exact, length / shortest", w.exact.length_m / shortest_m);
  }
  for (const WeighedWays& w : shown) add(w, "exact, mean information", w.exact.mean_information);
}

std::vector<std::string> MakeNotes(double half_way_alpha_per_m, bool paper_range_is_flat) {
  return {
      "The paper (Fig. 3) shows one scene three times, with the same samples, start and goal, at "
      "alpha = 0, 0.005 and 1, and says that a larger alpha makes the path shorter and less "
      "informative. The scene is printed as a picture only, and the unit of alpha is not said.",
      absl::StrFormat(
          "Ours: another scene, alpha per metre, the penalty P = 1 - UCB summed over cells of "
          "0.1 m, so that a metre without information costs 10. %s The change is half way at alpha "
          "= %.3g / m (last panel). Exact: cheapest path on the grid, straightened; shortest: "
          "Dijkstra in 32 directions.",
          paper_range_is_flat ? "Between alpha = 0 and 1 the path hardly changes."
                              : "Between alpha = 0 and 1 the path changes.",
          half_way_alpha_per_m)};
}

const WeighedWays& At(const std::vector<WeighedWays>& ways, double alpha_per_m) {
  return *std::find_if(ways.begin(), ways.end(),
                       [&](const WeighedWays& w) { return w.alpha_per_m == alpha_per_m; });
}

}  // namespace

absl::StatusOr<Study> RunXitFig3(const ExperimentOptions& options) {
  const SyntheticScene scene = BuildScene(DistanceWeightScene());
  const double shortest_m = Shortest_m(scene);
  const std::vector<double> alphas = Alphas(options.quick);
  std::vector<WeighedWays> ways;
  for (const double alpha_per_m : alphas) {
    if (options.progress) {
      options.progress(static_cast<double>(ways.size()) / static_cast<double>(alphas.size()));
    }
    ways.push_back(Weigh(scene, alpha_per_m, options.seed));
  }
  const WeighedWays& half_way = HalfWay(ways, shortest_m);
  const double detour_m = ways.front().exact.length_m - shortest_m;
  constexpr double kHardly = 0.2;  // of the detour
  const bool flat =
      std::abs(At(ways, 1.0).exact.length_m - ways.front().exact.length_m) < kHardly * detour_m;

  Study study;
  study.figures.title = "Effect of the distance weight on one path ([XIT] Fig. 3)";
  study.figures.notes = MakeNotes(half_way.alpha_per_m, flat);
  std::vector<WeighedWays> shown;
  for (const double alpha_per_m : kPaperAlphas) shown.push_back(At(ways, alpha_per_m));
  shown.push_back(half_way);
  for (const WeighedWays& w : shown) {
    study.figures.panels.push_back(MakePanel(scene, w, shortest_m));
    AddFigures(w, shortest_m,
               &w == &shown.back() ? "half_way" : absl::StrFormat("alpha_%.3g", w.alpha_per_m),
               study);
  }
  AddKeyNumbers(shown, shortest_m, study);
  study.figures.charts = {
      MakeChart("Length / shortest", ways,
                [&](const Way& way) { return way.length_m / shortest_m; }),
      MakeChart("Mean information", ways, [](const Way& way) { return way.mean_information; })};
  study.table = MakeTable(ways, shortest_m);
  study.summary.figures.emplace_back("shortest_m", shortest_m);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
