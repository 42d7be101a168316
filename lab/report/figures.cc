// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr double kDecades = 1e-3;        // of the greatest concentration: where its colours begin
constexpr double kLogarithmicFrom = 20;  // greatest over least variance that call for logarithms
constexpr double kMargin_m = 0.2;        // around what is known

// The cells that are known, by their centres; nothing if none is.
std::optional<Rectangle> KnownCenters(const Grid<CellState>& map) {
  const GridGeometry& geometry = map.geometry();
  std::optional<Rectangle> known;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] == CellState::kUnknown) continue;
    const Point2 center = geometry.Center(geometry.CellAtIndex(i));
    const Rectangle cell{center, center};
    known = known ? known->With(cell) : cell;
  }
  return known;
}

Rectangle ShownRegion(const ReportData& data) {
  if (data.truth.size() == 0) return KnownRegion(data.map.occupancy);
  const Rectangle truth = RegionOf(data.truth.geometry());
  const std::optional<Rectangle> known = KnownCenters(data.map.occupancy);
  return (known ? known->With(truth) : truth).Grown(kMargin_m);
}

// Least and greatest finite values; low > high if there are none.
Range FiniteRange(const std::vector<float>& values) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    range.low = std::min<double>(range.low, value);
    range.high = std::max<double>(range.high, value);
  }
  return range;
}

// Concentrations span decades: a logarithmic scale up to the greatest of truth and estimate.
ColorScale GasScale(const ReportData& data) {
  double high = FiniteRange(data.map.gas_mean_ppm.values()).high;
  if (data.true_gas_ppm) high = std::max(high, FiniteRange(data.true_gas_ppm->values()).high);
  if (!(high > 0.0)) high = 1.0;
  return {ColorMap::kGas, kDecades * high, high, true};
}

ColorScale VarianceScale(const ReportData& data) {
  const Range range = FiniteRange(data.map.gas_variance_ppm2.values());
  if (!(range.high > 0.0)) return {ColorMap::kUncertainty, 0.0, 1.0, false};
  if (range.low > 0.0 && range.high > kLogarithmicFrom * range.low) {
    return {ColorMap::kUncertainty, range.low, range.high, true};
  }
  return {ColorMap::kUncertainty, 0.0, range.high, false};
}

// Walls, and the values of the other cells; a value that is not finite shows the background.
CellPicture PaintField(const Grid<float>& field, const Grid<CellState>& walls,
                       const Rectangle& region, const ColorScale& scale) {
  return PaintCells(field.geometry(), region, [&](Cell cell) {
    if (walls[cell] == CellState::kOccupied) return kWallColor;
    return std::isfinite(field[cell]) ? scale(field[cell]) : kUnknownColor;
  });
}

Rgb FrontierColor(FrontierKind kind) {
  return kind == FrontierKind::kGas ? kGasFrontierColor : kOccupancyFrontierColor;
}

CellPicture PaintOccupancy(const MapSnapshot& map, const Rectangle& region) {
  const GridGeometry& geometry = map.occupancy.geometry();
  Grid<Rgb> colors(geometry);
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = StateColor(map.occupancy[i]);
  for (const Frontier& frontier : map.frontiers) {
    for (const Cell cell : frontier.cells) {
      if (geometry.Contains(cell)) colors[cell] = FrontierColor(frontier.kind);
    }
  }
  return PaintCells(geometry, region, [&colors](Cell cell) { return colors[cell]; });
}

// Where the chosen path of a plan ends; nothing if the plan was to stay.
std::optional<MapMark> GoalMark(const Plan& plan) {
  const auto chosen = static_cast<std::size_t>(plan.chosen);
  if (plan.chosen < 0 || chosen >= plan.candidates.size()) return std::nullopt;
  const Candidate& candidate = plan.candidates[chosen];
  if (candidate.path.empty()) return std::nullopt;
  return MapMark{MarkShape::kDisc, GoalColor(candidate.goal.kind), candidate.path.back()};
}

std::vector<MapMark> SourceMarks(const ReportData& data) {
  std::vector<MapMark> marks;
  for (const Point2& source : data.sources) {
    marks.push_back({MarkShape::kCross, kSourceColor, source});
  }
  return marks;
}

std::vector<MapLine> PathLines(const ReportData& data) {
  std::vector<MapLine> lines;
  for (std::size_t i = 0; i < data.driven_paths.size(); ++i) {
    lines.push_back({data.driven_paths[i], {kTeamColors[i % kTeamColors.size()], 1.8}});
  }
  return lines;
}

MapPanel OccupancyPanel(const ReportData& data, const Rectangle& region) {
  MapPanel panel{.title = "Occupancy, frontiers and paths",
                 .region = region,
                 .cells = PaintOccupancy(data.map, region),
                 .lines = PathLines(data),
                 .marks = {},
                 .color_bar = std::nullopt,
                 .legend = {{"occupied", MarkShape::kSwatch, kOccupiedColor},
                            {"unknown", MarkShape::kSwatch, kUnknownColor},
                            {"driven path", MarkShape::kLine, kTeamColors[0]},
                            {"occupancy frontier", MarkShape::kSwatch, kOccupancyFrontierColor},
                            {"gas frontier", MarkShape::kSwatch, kGasFrontierColor},
                            {"start", MarkShape::kDisc, kStartColor},
                            {"occupancy goal", MarkShape::kDisc, kOccupancyFrontierColor},
                            {"gas goal", MarkShape::kDisc, kGasFrontierColor},
                            {"source", MarkShape::kCross, kSourceColor}}};
  for (const Plan& plan : data.plans) {
    if (const std::optional<MapMark> mark = GoalMark(plan)) panel.marks.push_back(*mark);
  }
  for (const Point2& start : data.starts) {
    panel.marks.push_back({MarkShape::kDisc, kStartColor, start});
  }
  for (const MapMark& mark : SourceMarks(data)) panel.marks.push_back(mark);
  return panel;
}

MapPanel FieldPanel(const char* title, const Rectangle& region, CellPicture cells, ColorBar bar) {
  MapPanel panel;
  panel.title = title;
  panel.region = region;
  panel.cells = std::move(cells);
  panel.color_bar = std::move(bar);
  return panel;
}

Curve MetricCurve(const ReportData& data, const char* name, const Stroke& stroke,
                  double MetricPoint::*metric) {
  Curve curve{name, stroke, {}};
  for (const MetricPoint& sample : data.metrics) {
    curve.points.push_back({sample.time_s, sample.*metric});
  }
  return curve;
}

}  // namespace

Rectangle KnownRegion(const Grid<CellState>& map) {
  return KnownCenters(map).value_or(RegionOf(map.geometry())).Grown(kMargin_m);
}

Rgb StateColor(CellState state) {
  switch (state) {
    case CellState::kFree:
      return kFreeColor;
    case CellState::kOccupied:
      return kOccupiedColor;
    case CellState::kUnknown:
      break;
  }
  return kUnknownColor;
}

Rgb GoalColor(GoalKind kind) {
  switch (kind) {
    case GoalKind::kOccupancyFrontier:
      return kOccupancyFrontierColor;
    case GoalKind::kGasFrontier:
      return kGasFrontierColor;
    case GoalKind::kInformation:
    case GoalKind::kSite:
    case GoalKind::kHome:
      return kStartColor;
    case GoalKind::kRandomFreeSpace:
    case GoalKind::kMakeWay:
      break;
  }
  return kRandomGoalColor;
}

std::vector<MapPanel> MakeMapPanels(const ReportData& data) {
  const Rectangle region = ShownRegion(data);
  const ColorBar gas{GasScale(data), "ppm"};
  const ColorBar variance{VarianceScale(data), "ppm\u00B2"};
  std::vector<MapPanel> panels;
  if (data.true_gas_ppm) {
    panels.push_back(FieldPanel(
        "True gas", region, PaintField(*data.true_gas_ppm, data.truth, region, gas.scale), gas));
    panels.back().marks = SourceMarks(data);
  }
  panels.push_back(
      FieldPanel("Estimated mean", region,
                 PaintField(data.map.gas_mean_ppm, data.map.occupancy, region, gas.scale), gas));
  panels.back().marks = SourceMarks(data);
  panels.push_back(
      FieldPanel("Uncertainty (variance)", region,
                 PaintField(data.map.gas_variance_ppm2, data.map.occupancy, region, variance.scale),
                 variance));
  panels.push_back(OccupancyPanel(data, region));
  if (data.objective) {
    panels.push_back(ObjectivePanel(*data.objective, data.map, region));
    for (const MapMark& mark : SourceMarks(data)) panels.back().marks.push_back(mark);
  }
  if (data.team) {
    const Grid<CellState>& map = data.map.occupancy;
    panels.push_back(TubesPanel(*data.team, map, region, BusiestMoment_s(*data.team)));
    panels.push_back(DrivenPanel(*data.team, map, region));
  }
  return panels;
}

std::vector<Chart> MakeCharts(const ReportData& data) {
  constexpr Range kShares{0.0, 1.0};
  constexpr char kTime[] = "time, s";
  const Stroke solid{kLineColors[0], 2.0};
  const Stroke dashed{kFaintInk, 1.5, 5.0};
  std::vector<Curve> completeness = {
      MetricCurve(data, "completeness", solid, &MetricPoint::completeness)};
  if (data.server_killed_s) {
    const double time_s = *data.server_killed_s;
    completeness.push_back({"server killed",
                            Stroke{kLineColors[1], 1.5, 5.0},
                            {{time_s, kShares.low}, {time_s, kShares.high}}});
  }
  return {{"Completeness", kTime, kShares, std::move(completeness)},
          {"RMSE, critical cells, ppm",
           kTime,
           std::nullopt,
           {MetricCurve(data, "map", solid, &MetricPoint::rmse_ppm),
            MetricCurve(data, "all-zero map", dashed, &MetricPoint::rmse_zero_ppm)}},
          {"Entropy, critical cells, nats",
           kTime,
           std::nullopt,
           {MetricCurve(data, "entropy", solid, &MetricPoint::entropy_nats)}}};
}

}  // namespace plumescout::lab
