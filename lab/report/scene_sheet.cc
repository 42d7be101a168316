// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/scene_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/quantile.h"
#include "lab/report/cairo_canvas.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr Rgb kInletColor{36, 99, 201};
constexpr Rgb kOutletColor{222, 120, 20};
constexpr Rgb kCriticalColor{255, 255, 255};

bool IsFree(const Scene& scene, std::size_t index) {
  return scene.occupancy[index] == CellState::kFree;
}

bool IsCritical(const Scene& scene, std::size_t index) {
  return scene.conc_mean_ppm[index] > scene.critical_threshold_ppm;
}

// A thick line in the outer wall.
MapLine OpeningLine(const Opening& opening, const Rectangle& region) {
  constexpr double kInset_m = 0.1;  // half a usual wall
  const Point2 low = region.min;
  const Point2 high = region.max;
  std::vector<Point2> ends;
  switch (opening.side) {
    case Side::kWest:
      ends = {{low.x_m + kInset_m, opening.from_m}, {low.x_m + kInset_m, opening.to_m}};
      break;
    case Side::kEast:
      ends = {{high.x_m - kInset_m, opening.from_m}, {high.x_m - kInset_m, opening.to_m}};
      break;
    case Side::kSouth:
      ends = {{opening.from_m, low.y_m + kInset_m}, {opening.to_m, low.y_m + kInset_m}};
      break;
    case Side::kNorth:
      ends = {{opening.from_m, high.y_m - kInset_m}, {opening.to_m, high.y_m - kInset_m}};
      break;
  }
  constexpr double kWidth_px = 5.0;
  return {std::move(ends), {opening.inflow_mps ? kInletColor : kOutletColor, kWidth_px}};
}

void AddOpenings(const Scene& scene, MapPanel& panel) {
  for (const Opening& opening : scene.openings) {
    panel.lines.push_back(OpeningLine(opening, panel.region));
  }
}

void AddSources(const Scene& scene, MapPanel& panel) {
  for (const GasSource& source : scene.sources) {
    panel.marks.push_back({MarkShape::kCross, kSourceColor, {source.x_m, source.y_m}});
  }
}

MapPanel MapOf(const Scene& scene) {
  MapPanel panel;
  panel.title = "Map";
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(scene.geometry(), panel.region,
                           [&](Cell cell) { return StateColor(scene.occupancy[cell]); });
  AddOpenings(scene, panel);
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    const GasSource& source = scene.sources[i];
    panel.marks.push_back(
        {MarkShape::kDisc, kSourceColor, {source.x_m, source.y_m}, absl::StrCat(i + 1)});
  }
  constexpr double kLook_m = 0.6;
  const Pose2& start = scene.start_pose;
  panel.lines.push_back({{start.position(),
                          {start.x_m + kLook_m * std::cos(start.yaw_rad),
                           start.y_m + kLook_m * std::sin(start.yaw_rad)}},
                         {kStartColor, 3.0}});
  panel.marks.push_back({MarkShape::kDisc, kStartColor, start.position()});
  panel.legend = {{"source", MarkShape::kDisc, kSourceColor},
                  {"start", MarkShape::kDisc, kStartColor}};
  if (!scene.openings.empty()) {
    panel.legend.push_back({"air inlet", MarkShape::kSwatch, kInletColor});
    panel.legend.push_back({"air outlet", MarkShape::kSwatch, kOutletColor});
  }
  return panel;
}

float Speed_mps(const WindField& wind, std::size_t index) {
  return std::hypot(wind.u_mps[index], wind.v_mps[index]);
}

// Up to the speed that only one free cell in a hundred exceeds: a jet would darken all else.
ColorScale SpeedScale(const Scene& scene) {
  constexpr double kShare = 0.99;
  std::vector<float> speeds;
  for (std::size_t i = 0; i < scene.occupancy.size(); ++i) {
    if (IsFree(scene, i)) speeds.push_back(Speed_mps(*scene.wind, i));
  }
  const double high = Quantile(std::move(speeds), kShare);
  return {ColorMap::kGas, 0.0, high > 0.0 ? high : 1.0, false};
}

// An arrow of this length about `center` towards (u, v), which is not zero.
MapLine Arrow(Point2 center, double u, double v, double length_m, Rgb color) {
  constexpr double kHead = 0.35;  // of the length
  constexpr double kHalfHead = 0.2;
  const double speed = std::hypot(u, v);
  const double x = length_m * u / speed;
  const double y = length_m * v / speed;
  const Point2 tip{center.x_m + 0.5 * x, center.y_m + 0.5 * y};
  const Point2 left{tip.x_m - kHead * x - kHalfHead * y, tip.y_m - kHead * y + kHalfHead * x};
  const Point2 right{tip.x_m - kHead * x + kHalfHead * y, tip.y_m - kHead * y - kHalfHead * x};
  return {{{center.x_m - 0.5 * x, center.y_m - 0.5 * y}, tip, left, tip, right}, {color, 1.2}};
}

// Arrows of one length on a lattice, the mean wind of the cells around each; none where it is calm.
void AddArrows(const Scene& scene, const ColorScale& scale, MapPanel& panel) {
  constexpr int kAcross = 26;           // arrows along the longer side
  constexpr double kCalmShare = 0.02;   // of the scale's end
  constexpr double kBrightShare = 0.6;  // where white cannot be seen
  const GridGeometry& geometry = scene.geometry();
  const int step = std::max(1, std::max(geometry.width, geometry.height) / kAcross);
  const double length_m = 0.75 * step * geometry.resolution_m;
  for (int y = step / 2; y < geometry.height; y += step) {
    for (int x = step / 2; x < geometry.width; x += step) {
      const std::size_t index = geometry.Index({x, y});
      if (!IsFree(scene, index)) continue;
      const double share = scale.Share(Speed_mps(*scene.wind, index));
      if (share < kCalmShare) continue;
      panel.lines.push_back(Arrow(geometry.Center({x, y}), scene.wind->u_mps[index],
                                  scene.wind->v_mps[index], length_m,
                                  share < kBrightShare ? kPaper : kInk));
    }
  }
}

MapPanel WindOf(const Scene& scene) {
  const ColorScale scale = SpeedScale(scene);
  MapPanel panel;
  panel.title = absl::StrFormat("Wind, %.2g m above the floor", scene.sensor_height_m);
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(scene.geometry(), panel.region, [&](Cell cell) {
    const std::size_t index = scene.geometry().Index(cell);
    return IsFree(scene, index) ? scale(Speed_mps(*scene.wind, index)) : kWallColor;
  });
  AddArrows(scene, scale, panel);
  AddOpenings(scene, panel);
  panel.color_bar = ColorBar{scale, "m/s"};
  return panel;
}

// Edges between critical free cells and other free ones.
void AddCriticalOutline(const Scene& scene, MapPanel& panel) {
  const GridGeometry& geometry = scene.geometry();
  const auto corner = [&geometry](int x, int y) {
    return Point2{geometry.origin_x_m + x * geometry.resolution_m,
                  geometry.origin_y_m + y * geometry.resolution_m};
  };
  const auto differ = [&](Cell a, Cell b) {
    const std::size_t i = geometry.Index(a);
    const std::size_t j = geometry.Index(b);
    return IsFree(scene, i) && IsFree(scene, j) && IsCritical(scene, i) != IsCritical(scene, j);
  };
  const Stroke stroke{kCriticalColor, 1.4};
  for (int y = 1; y < geometry.height; ++y) {
    for (int x = 1; x < geometry.width; ++x) {
      if (differ({x, y}, {x - 1, y})) {
        panel.lines.push_back({{corner(x, y), corner(x, y + 1)}, stroke});
      }
      if (differ({x, y}, {x, y - 1})) {
        panel.lines.push_back({{corner(x, y), corner(x + 1, y)}, stroke});
      }
    }
  }
}

MapPanel GasOf(const Scene& scene) {
  const auto& values = scene.conc_mean_ppm.values();
  const double most = *std::max_element(values.begin(), values.end());
  constexpr double kDecades = 1e-3;  // of the scale, which the mean spans
  const double high = most > 0.0 ? most : 1.0;
  const ColorScale scale{ColorMap::kGas, kDecades * high, high, true};
  MapPanel panel;
  panel.title = absl::StrFormat("Gas, mean of %.0f s", scene.series.frames * scene.series.dt_s);
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(scene.geometry(), panel.region, [&](Cell cell) {
    const std::size_t index = scene.geometry().Index(cell);
    return IsFree(scene, index) ? scale(scene.conc_mean_ppm[index]) : kWallColor;
  });
  AddCriticalOutline(scene, panel);
  AddOpenings(scene, panel);
  AddSources(scene, panel);
  panel.marks.push_back({MarkShape::kDisc, kStartColor, scene.start_pose.position()});
  panel.color_bar = ColorBar{scale, "ppm"};
  panel.legend = {{absl::StrFormat("white line: %.3g ppm, the critical threshold",
                                   scene.critical_threshold_ppm),
                   MarkShape::kLine, kFrame}};
  return panel;
}

// Narrower for tall buildings, whose maps are bounded in height.
int PanelWidth_px(const Rectangle& region) {
  constexpr double kNarrowest_px = 330.0;  // title and legend
  constexpr double kWidest_px = 480.0;
  constexpr double kHeight_px = 620.0;
  const double width_px = kHeight_px * region.width_m() / region.height_m();
  return static_cast<int>(std::clamp(width_px, kNarrowest_px, kWidest_px));
}

std::string SourcesText(const Scene& scene) {
  std::string text = scene.sources.empty() ? "No sources" : "Sources:";
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    const GasSource& source = scene.sources[i];
    absl::StrAppendFormat(&text, "%s %d at (%.1f, %.1f) m", i == 0 ? "" : ",",
                          static_cast<int>(i) + 1, source.x_m, source.y_m);
    if (source.rate_ppm_per_s > 0.0) {  // an imported scene may not know
      absl::StrAppendFormat(&text, " with %.0f ppm/s", source.rate_ppm_per_s);
    }
  }
  return text;
}

std::string FiguresText(const Scene& scene) {
  const GridGeometry& geometry = scene.geometry();
  int free_cells = 0;
  int critical = 0;
  for (std::size_t i = 0; i < scene.occupancy.size(); ++i) {
    if (!IsFree(scene, i)) continue;
    ++free_cells;
    critical += IsCritical(scene, i) ? 1 : 0;
  }
  return absl::StrFormat(
      "%.1f m x %.1f m in cells of %.2f m; %d free cells, %.0f %% of them critical; %d frames, one "
      "every %.2g s",
      geometry.width * geometry.resolution_m, geometry.height * geometry.resolution_m,
      geometry.resolution_m, free_cells, 100.0 * critical / std::max(1, free_cells),
      scene.series.frames, scene.series.dt_s);
}

}  // namespace

std::vector<MapPanel> MakeScenePanels(const Scene& scene) {
  std::vector<MapPanel> panels = {MapOf(scene)};
  if (scene.wind) panels.push_back(WindOf(scene));
  panels.push_back(GasOf(scene));
  return panels;
}

Image DrawSceneSheet(const Scene& scene) {
  constexpr int kMargin_px = 32;
  constexpr int kGap_px = 40;
  constexpr int kTop_px = 104;
  const std::vector<MapPanel> panels = MakeScenePanels(scene);
  const int panel_px = PanelWidth_px(panels.front().region);
  const double height_px = std::ceil(MapPanelHeight_px(panels.front(), panel_px));
  const int count = static_cast<int>(panels.size());
  const int width_px = 2 * kMargin_px + count * panel_px + (count - 1) * kGap_px;
  const int sheet_px = 2 * kMargin_px + kTop_px + static_cast<int>(height_px);
  return DrawImage(width_px, sheet_px, kPaper, [&](Canvas& canvas) {
    canvas.Text({kMargin_px, 54.0}, absl::StrCat("Scene ", scene.name),
                {26.0, kInk, Anchor::kStart, true});
    canvas.Text({kMargin_px, 84.0}, FiguresText(scene), {14.0, kInk});
    canvas.Text({kMargin_px, 106.0}, SourcesText(scene), {14.0, kInk});
    double x = kMargin_px;
    for (const MapPanel& panel : panels) {
      DrawMapPanel(canvas, {x, kMargin_px + kTop_px, static_cast<double>(panel_px), height_px},
                   panel);
      x += panel_px + kGap_px;
    }
  });
}

}  // namespace plumescout::lab
