// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/sampling_pictures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "lab/trials/convergence.h"

namespace plumescout::lab {
namespace {

constexpr Rgb kLatestColor = {206, 30, 60};
constexpr double kHighShare = 0.4;  // of the truth's maximum: the plume shows beside its peaks

ColorScale ScaleOf(const Scene& scene) {
  const std::vector<float>& gas_ppm = scene.conc_mean_ppm.values();
  const float most = *std::max_element(gas_ppm.begin(), gas_ppm.end());
  return {ColorMap::kGas, 0.0, std::max(1e-9, kHighShare * static_cast<double>(most)), false};
}

MapPanel GasPanel(const Scene& scene, const Grid<float>& gas_ppm, std::string title) {
  const ColorScale scale = ScaleOf(scene);
  MapPanel panel;
  panel.title = std::move(title);
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(scene.geometry(), panel.region, [&](Cell cell) {
    if (scene.occupancy[cell] != CellState::kFree) return kOccupiedColor;
    const Point2 place = scene.geometry().Center(cell);
    const float value = gas_ppm.At(gas_ppm.geometry().CellAt(place), 0.0F);
    return scale(std::isfinite(value) ? value : 0.0F);
  });
  panel.color_bar = ColorBar{scale, "ppm"};
  return panel;
}

// What has been driven and sampled since the drive began.
struct Progress {
  std::vector<Point2> sampled;
  std::vector<Point2> latest;  // by the last plan
  std::vector<Point2> way;     // of the last plan
  int updates = 0;
};

void TakePlan(const Plan& plan, Progress& progress) {
  progress.sampled.insert(progress.sampled.end(), progress.latest.begin(), progress.latest.end());
  progress.latest.clear();
  progress.way.clear();
  for (const Waypoint& waypoint : plan.trajectory.waypoints) {
    progress.way.push_back(waypoint.pose.position());
    if (waypoint.dwell_s > 0.0) progress.latest.push_back(waypoint.pose.position());
  }
  ++progress.updates;
}

// A small cross of lines: marks of the size of a site.
void AddSites(const std::vector<Point2>& sites, double reach_m, Rgb color, double width_px,
              MapPanel& panel) {
  for (const Point2 site : sites) {
    const Stroke stroke{color, width_px};
    panel.lines.push_back(
        {{{site.x_m - reach_m, site.y_m}, {site.x_m + reach_m, site.y_m}}, stroke});
    panel.lines.push_back(
        {{{site.x_m, site.y_m - reach_m}, {site.x_m, site.y_m + reach_m}}, stroke});
  }
}

MapPanel UpdatePanel(const Scene& scene, const MapSnapshot& map, const ErrorPoint& error,
                     const Progress& progress) {
  MapPanel panel = GasPanel(scene, map.gas_mean_ppm,
                            absl::StrFormat("%.0f s, RMSE %.2f ppm", error.time_s, error.rmse_ppm));
  constexpr double kReach = 0.3;
  const double reach_m = kReach * scene.geometry().resolution_m;
  panel.lines.push_back({progress.way, {kPaper, 1.2}});
  AddSites(progress.sampled, reach_m, kPaper, 1.0, panel);
  AddSites(progress.latest, 2.0 * reach_m, kLatestColor, 2.0, panel);
  return panel;
}

}  // namespace

MapPanel TruthPanel(const Scene& scene) {
  MapPanel panel = GasPanel(scene, scene.conc_mean_ppm, "The truth");
  for (const GasSource& source : scene.sources) {
    panel.marks.push_back({MarkShape::kCross, kSourceColor, {source.x_m, source.y_m}});
  }
  return panel;
}

absl::StatusOr<std::vector<MapPanel>> PictureUpdates(const SamplingPlan& plan, std::size_t row,
                                                     std::size_t number,
                                                     const std::vector<int>& updates) {
  const Scene& scene = plan.worlds[plan.cases[number].world];
  Progress progress;
  int pictured = 0;
  std::vector<MapPanel> panels;
  SamplingWatch watch;
  watch.on_plan = [&](double, const Plan& made) { TakePlan(made, progress); };
  watch.on_map = [&](const ErrorPoint& error, const MapSnapshot& map) {
    const bool wanted =
        std::find(updates.begin(), updates.end(), progress.updates) != updates.end();
    if (!wanted || progress.updates == pictured) return;
    pictured = progress.updates;
    panels.push_back(UpdatePanel(scene, map, error, progress));
  };
  PLUMESCOUT_RETURN_IF_ERROR(RunSamplingCase(plan, row, number, watch).status());
  return panels;
}

absl::StatusOr<MapPanel> PictureTime(const SamplingPlan& plan, std::size_t row, std::size_t number,
                                     double time_s) {
  struct Moment {
    ErrorPoint error;
    MapSnapshot map;
    Progress progress;
  };
  Progress progress;
  std::optional<Moment> latest;
  SamplingWatch watch;
  watch.on_plan = [&](double, const Plan& made) { TakePlan(made, progress); };
  watch.on_map = [&](const ErrorPoint& error, const MapSnapshot& map) {
    if (!latest || latest->error.time_s < time_s) latest = Moment{error, map, progress};
  };
  PLUMESCOUT_RETURN_IF_ERROR(RunSamplingCase(plan, row, number, watch).status());
  if (!latest) return absl::InternalError("a drive without a map");
  const Scene& scene = plan.worlds[plan.cases[number].world];
  return UpdatePanel(scene, latest->map, latest->error, latest->progress);
}

Chart MakeMeanErrorChart(const std::vector<NamedDrives>& rows, const std::string& title) {
  constexpr double kSecondsPerMinute = 60.0;
  constexpr double kSteps = 400.0;
  double end_s = 0.0;
  for (const NamedDrives& row : rows) {
    for (const SamplingDrive& drive : row.drives) {
      end_s = std::max(end_s, drive.errors.back().time_s);
    }
  }
  Chart chart{title, "time, min", std::nullopt, {}};
  if (!(end_s > 0.0)) return chart;
  const std::vector<double> times_s = EvenTimes_s(end_s, end_s / kSteps);
  for (const NamedDrives& row : rows) {
    Curve curve;
    curve.name = row.name;
    curve.stroke = {row.color, 2.0};
    std::vector<ErrorCurve> errors;
    for (const SamplingDrive& drive : row.drives) errors.push_back(drive.errors);
    for (const ErrorPoint& point : MeanCurve(errors, times_s)) {
      curve.points.push_back({point.time_s / kSecondsPerMinute, point.rmse_ppm});
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

CsvTable MakeDriveTable(const SamplingPlan& plan,
                        const std::vector<std::vector<SamplingDrive>>& drives) {
  CsvTable table;
  table.label_columns = {"row", "case"};
  table.columns = {"seed",           "distance_m",     "samples",      "elapsed_s",
                   "final_rmse_ppm", "least_rmse_ppm", "least_rmse_s", "convergence_s"};
  for (std::size_t row = 0; row < drives.size(); ++row) {
    for (std::size_t i = 0; i < drives[row].size(); ++i) {
      const SamplingDrive& drive = drives[row][i];
      const ErrorPoint least = LeastError(drive.errors).value_or(ErrorPoint{});
      table.labels.push_back({plan.rows[row].name, plan.cases[i].name});
      table.rows.push_back({static_cast<double>(plan.cases[i].seed), drive.driven_m,
                            static_cast<double>(drive.samples), drive.elapsed_s,
                            FinalError(drive.errors).value_or(ErrorPoint{}).rmse_ppm,
                            least.rmse_ppm, least.time_s,
                            ConvergenceTime_s(drive.errors).value_or(drive.elapsed_s)});
    }
  }
  return table;
}

}  // namespace plumescout::lab
