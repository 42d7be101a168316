// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/mit_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "lab/report/palette.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {
namespace {

// Orange, cyan and magenta, as in the paper.
constexpr Rgb kTrajectoryColors[kTrajectories] = {{238, 128, 22}, {0, 190, 214}, {214, 40, 160}};
constexpr Rgb kStartMark{22, 150, 84};
constexpr Rgb kDiscColor{60, 220, 90};
constexpr Rgb kDrivenColor{242, 166, 176};

MapPanel FieldPanel(const MitScene& scene, std::string title) {
  const ColorScale scale{ColorMap::kGas, 0.0, 1.0, false};
  MapPanel panel;
  panel.title = std::move(title);
  panel.region = RegionOf(scene.occupancy.geometry());
  panel.cells = PaintCells(scene.occupancy.geometry(), panel.region, [&](Cell cell) {
    if (scene.occupancy[cell] != CellState::kFree) return kWallColor;
    return std::isfinite(scene.information.penalty[cell]) ? scale(scene.information.value[cell])
                                                          : kUnknownColor;
  });
  panel.marks.push_back({MarkShape::kDisc, kStartMark, scene.start, "S"});
  for (std::size_t i = 0; i < kTrajectories; ++i) {
    panel.marks.push_back(
        {MarkShape::kDisc, kTrajectoryColors[i], scene.goals[i].position, absl::StrCat(i + 1)});
  }
  panel.color_bar = ColorBar{scale, "UCB"};
  return panel;
}

std::vector<Point2> Circle(Point2 center, double radius_m) {
  constexpr int kCorners = 48;
  std::vector<Point2> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kCorners;
    points.push_back(
        {center.x_m + radius_m * std::cos(angle_rad), center.y_m + radius_m * std::sin(angle_rad)});
  }
  return points;
}

}  // namespace

MapPanel MitScenePanel(const MitScene& scene, std::string title) {
  MapPanel panel = FieldPanel(scene, std::move(title));
  panel.lines.push_back({scene.driven, {kDrivenColor, 1.8, 5.0}});
  panel.legend = {{"start", MarkShape::kDisc, kStartMark},
                  {"driven", MarkShape::kLine, kDrivenColor},
                  {"inflated", MarkShape::kSwatch, kUnknownColor}};
  return panel;
}

MapPanel MitRunsPanel(const MitScene& scene, const std::vector<MitRun>& runs, std::string title,
                      bool discs) {
  constexpr std::size_t kThin = 25;
  MapPanel panel = FieldPanel(scene, std::move(title));
  for (std::size_t i = 0; i < std::min(kThin, runs.size()); ++i) {
    for (const auto& path : runs[i].paths) panel.lines.push_back({path, {kPaper, 0.5}});
  }
  for (std::size_t t = 0; t < kTrajectories; ++t) {
    if (discs) {
      const std::vector<Point2> circle = Circle(scene.goals[t].position, kGoalRadius_m);
      panel.lines.push_back({circle, {kDiscColor, 2.5}});
    }
    std::vector<const std::vector<Point2>*> paths;
    for (const MitRun& run : runs) paths.push_back(&run.paths[t]);
    const int typical = MostTypical(paths);
    if (typical < 0) continue;
    AddPath(*paths[static_cast<std::size_t>(typical)], {kTrajectoryColors[t], 3.5}, panel);
    panel.legend.push_back(
        {absl::StrCat("trajectory ", t + 1), MarkShape::kLine, kTrajectoryColors[t]});
  }
  return panel;
}

}  // namespace plumescout::lab
