// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_fig5.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "lab/about/about.h"
#include "lab/report/palette.h"
#include "lab/worlds/frontier_world.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {
namespace {

constexpr Rgb kUnobservedColor{255, 255, 250};
constexpr Rgb kObservedColor{214, 228, 244};
constexpr Rgb kCriticalColor{250, 205, 160};
constexpr Rgb kPathColor{206, 30, 140};
// Of gas frontiers.
constexpr Rgb kClusterColors[] = {{20, 140, 140}, {142, 68, 173}, {36, 99, 201}, {120, 85, 40}};

struct Walks {
  FrontierWalk everywhere;  // WgfdScope::kReachable
  FrontierWalk local;       // kLocal
};

Rgb ColorOf(GasMark cell) {
  switch (cell) {
    case GasMark::kWall:
      return kOccupiedColor;
    case GasMark::kUnobserved:
      return kUnobservedColor;
    case GasMark::kObserved:
      return kObservedColor;
    case GasMark::kCritical:
      return kCriticalColor;
    case GasMark::kUnknown:
      break;
  }
  return kUnknownColor;
}

// The path that a step chose; empty if it stays.
std::vector<Point2> ChosenPath(const FrontierStep& step) {
  if (step.plan.chosen < 0) return {};
  return step.plan.candidates[static_cast<std::size_t>(step.plan.chosen)].path;
}

std::string GoalText(const FrontierStep& step) {
  if (step.plan.chosen < 0) return "stays";
  switch (step.plan.candidates[static_cast<std::size_t>(step.plan.chosen)].goal.kind) {
    case GoalKind::kGasFrontier:
      return "to a gas frontier";
    case GoalKind::kOccupancyFrontier:
      return "to an occupancy frontier";
    case GoalKind::kInformation:
      return "to a place where readings tell much";
    case GoalKind::kRandomFreeSpace:
      return "to a fallback goal";
    case GoalKind::kHome:
    case GoalKind::kSite:
    case GoalKind::kMakeWay:
      break;
  }
  return "home";
}

std::string CountText(std::size_t frontiers) {
  return absl::StrCat(frontiers, frontiers == 1 ? " gas frontier" : " gas frontiers");
}

void AddCellEdges(const GridGeometry& geometry, MapPanel& panel) {
  const Stroke edge{kGridLine, 0.6};
  const Rectangle region = RegionOf(geometry);
  for (int x = 0; x <= geometry.width; ++x) {
    const double x_m = geometry.origin_x_m + x * geometry.resolution_m;
    panel.lines.push_back({{{x_m, region.min.y_m}, {x_m, region.max.y_m}}, edge});
  }
  for (int y = 0; y <= geometry.height; ++y) {
    const double y_m = geometry.origin_y_m + y * geometry.resolution_m;
    panel.lines.push_back({{{region.min.x_m, y_m}, {region.max.x_m, y_m}}, edge});
  }
}

MapPanel StepPanel(const FrontierWorld& world, const FrontierStep& step, const char* letter,
                   const char* row) {
  std::vector<const Frontier*> frontiers = GasFrontiers(step.map);
  // From the south, so that a cluster keeps its colour from step to step.
  std::sort(frontiers.begin(), frontiers.end(),
            [](const Frontier* a, const Frontier* b) { return a->centroid.y_m < b->centroid.y_m; });
  MapPanel panel;
  panel.title = absl::StrCat("(", letter, ") ", row, ": ", GoalText(step));
  panel.region = RegionOf(world.occupancy.geometry());
  const Grid<GasMark> cells = ClassifyGas(step);
  Grid<Rgb> colors(cells.geometry());
  for (std::size_t i = 0; i < cells.size(); ++i) colors[i] = ColorOf(cells[i]);
  for (std::size_t k = 0; k < frontiers.size(); ++k) {
    for (const Cell cell : frontiers[k]->cells) {
      colors[cell] = kClusterColors[k % std::size(kClusterColors)];
    }
  }
  panel.cells =
      PaintCells(colors.geometry(), panel.region, [&](Cell cell) { return colors[cell]; });
  AddCellEdges(world.occupancy.geometry(), panel);
  panel.lines.push_back({step.driven, {kFaintInk, 1.5}});
  AddPath(ChosenPath(step), {kPathColor, 3.5}, panel);
  panel.marks.push_back({MarkShape::kDisc, kStartColor, step.robot.position()});
  panel.legend = {{"critical", MarkShape::kSwatch, kCriticalColor},
                  {"observed", MarkShape::kSwatch, kObservedColor},
                  {"gas unobserved", MarkShape::kSwatch, kUnobservedColor},
                  {"gas frontier 1", MarkShape::kSwatch, kClusterColors[0]},
                  {"gas frontier 2", MarkShape::kSwatch, kClusterColors[1]},
                  {"map unknown", MarkShape::kSwatch, kUnknownColor},
                  {"path chosen", MarkShape::kLine, kPathColor},
                  {"driven", MarkShape::kLine, kFaintInk},
                  {"robot", MarkShape::kDisc, kStartColor}};
  return panel;
}

ColorScale GasScale(const FrontierWorld& world) {
  constexpr double kLeast_ppm = 0.5;
  const float greatest_ppm =
      *std::max_element(world.gas_ppm.values().begin(), world.gas_ppm.values().end());
  return {ColorMap::kGas, kLeast_ppm, static_cast<double>(greatest_ppm), true};
}

MapPanel GasPanel(const FrontierWorld& world, const Grid<float>& gas_ppm,
                  const Grid<CellState>& states, std::string title) {
  const ColorScale scale = GasScale(world);
  MapPanel panel;
  panel.title = std::move(title);
  panel.region = RegionOf(world.occupancy.geometry());
  panel.cells = PaintCells(gas_ppm.geometry(), panel.region, [&](Cell cell) {
    if (states[cell] == CellState::kOccupied) return kWallColor;
    return states[cell] == CellState::kFree ? scale(gas_ppm[cell]) : kUnknownColor;
  });
  AddCellEdges(world.occupancy.geometry(), panel);
  panel.marks.push_back({MarkShape::kCross, kSourceColor, world.source});
  panel.color_bar = ColorBar{scale, "ppm"};
  panel.legend = {{"leak", MarkShape::kCross, kSourceColor}};
  return panel;
}

void AddRow(const FrontierWorld& world, const FrontierWalk& walk, const char* row,
            std::vector<MapPanel>& panels) {
  constexpr const char* kLetters[] = {"a", "b", "c"};
  for (std::size_t i = 0; i < std::min(walk.steps.size(), std::size(kLetters)); ++i) {
    panels.push_back(StepPanel(world, walk.steps[i], kLetters[i], row));
  }
}

template <typename Value>
Chart MakeChart(const char* title, const Walks& walks, Value&& value) {
  Chart chart{title, "driven, m", std::nullopt, {}};
  const std::pair<const char*, const FrontierWalk*> curves[] = {{"everywhere", &walks.everywhere},
                                                                {"Alg. 2", &walks.local}};
  std::size_t color = 0;
  for (const auto& [name, walk] : curves) {
    Curve curve{name, {kLineColors[color++], 2.0}, {}};
    for (const FrontierReading& reading : walk->readings) {
      curve.points.push_back({reading.driven_m, static_cast<double>(value(reading))});
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

float MeanAtRobot_ppm(const FrontierStep& step) {
  return step.map.gas_mean_ppm[step.map.occupancy.geometry().CellAt(step.robot.position())];
}

// `each(letter, step)` for the steps of a walk.
template <typename Each>
void ForEachStep(const FrontierWalk& walk, Each&& each) {
  for (std::size_t i = 0; i < walk.steps.size(); ++i) {
    each(std::string(1, static_cast<char>('a' + i)), walk.steps[i]);
  }
}

void AddHeadline(const char* row, const FrontierWalk& walk, ReportFigures& figures) {
  ForEachStep(walk, [&](const std::string& letter, const FrontierStep& step) {
    figures.key_numbers.emplace_back(absl::StrFormat("(%s), %s", letter, row),
                                     CountText(GasFrontiers(step.map).size()));
  });
}

void AddNumbers(const char* row, const char* slug, const FrontierWalk& walk, Study& study) {
  ForEachStep(walk, [&](const std::string& letter, const FrontierStep& step) {
    study.figures.key_numbers.emplace_back(
        absl::StrFormat("(%s), %s: mean at the robot, tau", letter, row),
        absl::StrFormat("%.3f, %.2f ppm", MeanAtRobot_ppm(step), step.map.gas_threshold_ppm));
    const std::string prefix = absl::StrCat(slug, "_", letter, "_");
    study.summary.figures.emplace_back(prefix + "gas_frontiers",
                                       static_cast<double>(GasFrontiers(step.map).size()));
    study.summary.figures.emplace_back(prefix + "threshold_ppm", step.map.gas_threshold_ppm);
    study.summary.figures.emplace_back(prefix + "mean_at_robot_ppm", MeanAtRobot_ppm(step));
    study.summary.figures.emplace_back(prefix + "path_m", PathLength_m(ChosenPath(step)));
  });
}

// "2, 1, 1"
std::string Counts(const FrontierWalk& walk) {
  return absl::StrJoin(walk.steps, ", ", [](std::string* text, const FrontierStep& step) {
    absl::StrAppend(text, GasFrontiers(step.map).size());
  });
}

std::vector<std::string> MakeNotes(const Walks& walks) {
  std::string scopes = absl::StrFormat(
      "Upper row: WGFD everywhere, our default; gas frontiers at (a), (b), (c): %s. Lower row: the "
      "paper's Alg. 2, which floods only the critical region that the robot stands in: %s.",
      Counts(walks.everywhere), Counts(walks.local));
  constexpr std::size_t kB = 1;
  const bool forgets = walks.local.steps.size() > kB &&
                       GasFrontiers(walks.local.steps[kB].map).empty() &&
                       !GasFrontiers(walks.everywhere.steps[kB].map).empty();
  if (forgets) {
    scopes +=
        " At (b) the robot stands below tau_gas, so Alg. 2 returns nothing (lines 3-4), forgets "
        "the "
        "other frontier, and the robot goes elsewhere: as printed, the algorithm does not make the "
        "paper's figure.";
  }
  return {
      "The paper's Fig. 5 is a drawing of three steps: (a) the robot finds itself in gas above "
      "tau_gas, with two gas frontiers, and takes one; (b) there the gas is below tau_gas and no "
      "frontier emerges, so it takes the other one; (c) which leads to more gas and a new "
      "frontier.",
      "Here every cell is computed: a robot drives through a small building in which gas diffuses "
      "from a leak to vents, with a scan and a noisy reading at every cell's length, 0.25 m. Map, "
      "posterior, WGFD, goals (XIT-GFF) and paths are those of a mission with default options, but "
      "for the least size of a gas frontier, 3 cells, as wide as a corridor; the shortest trip, "
      "0.2 m; and no slots for occupancy frontiers while there are gas frontiers, since the figure "
      "is about these alone. World and entry were made so that the story can happen.",
      std::move(scopes)};
}

CsvTable MakeTable(const Walks& walks) {
  CsvTable table;
  table.columns = {"local_scope",    "step",          "x_m",           "y_m",
                   "driven_m",       "reading_ppm",   "threshold_ppm", "observed_cells",
                   "critical_cells", "gas_frontiers", "frontier_cells"};
  for (const FrontierWalk* walk : {&walks.everywhere, &walks.local}) {
    for (const FrontierReading& r : walk->readings) {
      table.rows.push_back({walk == &walks.local ? 1.0 : 0.0, static_cast<double>(r.step),
                            r.position.x_m, r.position.y_m, r.driven_m, r.reading_ppm,
                            r.threshold_ppm, static_cast<double>(r.observed_cells),
                            static_cast<double>(r.critical_cells), static_cast<double>(r.frontiers),
                            static_cast<double>(r.frontier_cells)});
    }
  }
  return table;
}

}  // namespace

absl::StatusOr<Study> RunXitFig5(const ExperimentOptions& options) {
  const FrontierWorld world = MakeFrontierWorld();
  Study study;
  study.figures.title = "Gas frontiers, cell by cell ([XIT] Fig. 5)";
  study.summary.about = AboutThisRun(options.seed);
  const auto walk = [&](WgfdScope scope) { return *WalkFrontiers(world, scope, options.seed); };
  const Walks walks{walk(WgfdScope::kReachable), walk(WgfdScope::kLocal)};
  if (options.progress) options.progress(1.0);
  std::vector<MapPanel>& panels = study.figures.panels;
  panels.push_back(GasPanel(world, world.gas_ppm, world.occupancy, "True gas"));
  AddRow(world, walks.everywhere, "everywhere", panels);
  const MapSnapshot& last = walks.everywhere.steps.back().map;
  panels.push_back(
      GasPanel(world, last.gas_mean_ppm, last.occupancy, "Estimated mean at (c), everywhere"));
  AddRow(world, walks.local, "Alg. 2", panels);
  study.figures.charts = {
      MakeChart("Gas frontiers", walks, [](const FrontierReading& r) { return r.frontiers; }),
      MakeChart("Critical cells", walks, [](const FrontierReading& r) { return r.critical_cells; }),
      MakeChart("Readings, ppm", walks, [](const FrontierReading& r) { return r.reading_ppm; })};
  study.figures.notes = MakeNotes(walks);
  AddHeadline("everywhere", walks.everywhere, study.figures);
  AddHeadline("Alg. 2", walks.local, study.figures);
  AddNumbers("everywhere", "everywhere", walks.everywhere, study);
  AddNumbers("Alg. 2", "local", walks.local, study);
  study.table = MakeTable(walks);
  return study;
}

}  // namespace plumescout::lab
