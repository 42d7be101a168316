// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/error_maps.h"

#include <algorithm>
#include <cmath>

#include "lab/report/figures.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr std::size_t kOneInMost = 20;  // critical cells

bool IsCritical(const Scene& scene, Cell cell) {
  return scene.occupancy.At(cell, CellState::kOccupied) == CellState::kFree &&
         scene.conc_mean_ppm[cell] > scene.critical_threshold_ppm;
}

// Indices of the part's cells, those of most gas first.
std::vector<std::size_t> PartCells(const Scene& scene, GasPart part) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < scene.conc_mean_ppm.size(); ++i) {
    if (IsCritical(scene, scene.geometry().CellAtIndex(i))) cells.push_back(i);
  }
  const Grid<float>& gas_ppm = scene.conc_mean_ppm;
  std::stable_sort(cells.begin(), cells.end(),
                   [&](std::size_t a, std::size_t b) { return gas_ppm[a] > gas_ppm[b]; });
  const auto most = static_cast<std::ptrdiff_t>(cells.size() / kOneInMost);
  if (part == GasPart::kMost) return {cells.begin(), cells.begin() + most};
  return {cells.begin() + most, cells.end()};
}

double SumOfSquares(const Scene& scene, GasPart part) {
  double sum = 0.0;
  for (const std::size_t i : PartCells(scene, part)) {
    sum += static_cast<double>(scene.conc_mean_ppm[i]) * scene.conc_mean_ppm[i];
  }
  return sum;
}

double Error_ppm(const Scene& scene, const Grid<float>& mean_ppm, std::size_t i) {
  const float mean = mean_ppm[i];
  return (std::isfinite(mean) ? mean : 0.0F) - scene.conc_mean_ppm[i];
}

Grid<float> ErrorMap(const Scene& scene, const std::vector<TrialRecord>& trials, std::size_t map) {
  Grid<float> rmse(scene.geometry());
  for (std::size_t i = 0; i < rmse.size(); ++i) {
    double squares = 0.0;
    for (const TrialRecord& trial : trials) {
      const double error = Error_ppm(scene, trial.mean_ppm[map], i);
      squares += error * error;
    }
    rmse[i] = static_cast<float>(std::sqrt(squares / static_cast<double>(trials.size())));
  }
  return rmse;
}

// Edges between critical cells and others.
std::vector<MapLine> CriticalOutline(const Scene& scene) {
  constexpr Stroke kOutline{{226, 54, 54}, 1.2};
  const GridGeometry& geometry = scene.geometry();
  std::vector<MapLine> lines;
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const Point2 corner{geometry.origin_x_m + x * geometry.resolution_m,
                          geometry.origin_y_m + y * geometry.resolution_m};
      const double r = geometry.resolution_m;
      const bool here = IsCritical(scene, {x, y});
      if (here != IsCritical(scene, {x - 1, y})) {
        lines.push_back({{corner, {corner.x_m, corner.y_m + r}}, kOutline});
      }
      if (here != IsCritical(scene, {x, y - 1})) {
        lines.push_back({{corner, {corner.x_m + r, corner.y_m}}, kOutline});
      }
    }
  }
  return lines;
}

}  // namespace

std::vector<double> PartErrors_ppm(const Scene& scene, const std::vector<TrialRecord>& trials,
                                   std::size_t map, GasPart part) {
  const std::vector<std::size_t> cells = PartCells(scene, part);
  std::vector<double> errors_ppm;
  for (const TrialRecord& trial : trials) {
    double squares = 0.0;
    for (const std::size_t i : cells) {
      const double error = Error_ppm(scene, trial.mean_ppm[map], i);
      squares += error * error;
    }
    errors_ppm.push_back(cells.empty() ? 0.0
                                       : std::sqrt(squares / static_cast<double>(cells.size())));
  }
  return errors_ppm;
}

double ShareOfSquares(const Scene& scene, GasPart part) {
  const double all = SumOfSquares(scene, GasPart::kMost) + SumOfSquares(scene, GasPart::kRest);
  return all > 0.0 ? SumOfSquares(scene, part) / all : 0.0;
}

MapPanel MakeErrorPanel(const Scene& scene, const std::vector<TrialRecord>& trials, std::size_t map,
                        const std::string& title) {
  constexpr double kHighest_ppm = 60.0;
  const ColorScale scale{ColorMap::kGas, 0.0, kHighest_ppm, false};
  const Grid<float> rmse = ErrorMap(scene, trials, map);
  MapPanel panel;
  panel.title = title;
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(scene.geometry(), panel.region, [&](Cell cell) {
    return scene.occupancy[cell] == CellState::kFree ? scale(rmse[cell]) : kPaper;
  });
  panel.lines = CriticalOutline(scene);
  panel.color_bar = ColorBar{scale, "RMSE, ppm"};
  panel.legend = {{"critical cells", MarkShape::kLine, {226, 54, 54}}};
  return panel;
}

}  // namespace plumescout::lab
