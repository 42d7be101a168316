// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/sampling_pictures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/types/options.h"
#include "core/types/status_macros.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/convergence.h"
#include "lab/trials/statistics.h"

namespace plumescout::lab {
namespace {

constexpr Rgb kLatestColor = {206, 30, 60};
constexpr Rgb kReferenceColor = {120, 120, 120};
constexpr double kSecondsPerMinute = 60.0;
constexpr double kReach = 0.3;      // of a mark, in cells
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
  const double reach_m = kReach * scene.geometry().resolution_m;
  panel.lines.push_back({progress.way, {kPaper, 1.2}});
  AddSites(progress.sampled, reach_m, kPaper, 1.0, panel);
  AddSites(progress.latest, 2.0 * reach_m, kLatestColor, 2.0, panel);
  return panel;
}

// Variances from nothing to what an open field without readings has.
MapPanel VariancePanel(const Scene& scene, const MapSnapshot& map, const ErrorPoint& error,
                       double open_ppm2) {
  const ColorScale scale{ColorMap::kUncertainty, 0.0, open_ppm2, false};
  MapPanel panel;
  panel.title = absl::StrFormat("variance, %.0f s", error.time_s);
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(scene.geometry(), panel.region, [&](Cell cell) {
    if (scene.occupancy[cell] != CellState::kFree) return kOccupiedColor;
    const Grid<float>& variance_ppm2 = map.gas_variance_ppm2;
    const Cell at = variance_ppm2.geometry().CellAt(scene.geometry().Center(cell));
    const float value = variance_ppm2.At(at, static_cast<float>(open_ppm2));
    return scale(std::isfinite(value) ? value : open_ppm2);
  });
  panel.color_bar = ColorBar{scale, "ppm²"};
  return panel;
}

// A map, and what had been done for it.
struct Moment {
  ErrorPoint error;
  MapSnapshot map;
  Progress progress;
};

void AddSources(const Scene& scene, MapPanel& panel) {
  for (const GasSource& source : scene.sources) {
    panel.marks.push_back({MarkShape::kCross, kSourceColor, {source.x_m, source.y_m}});
  }
}

// Means of the errors in each world at these times: by world and time.
std::vector<ErrorCurve> WorldCurves(const SamplingPlan& plan, const NamedDrives& row,
                                    const std::vector<double>& times_s) {
  std::vector<ErrorCurve> curves;
  for (const std::vector<SamplingDrive>& world : ByWorld(plan, row.drives)) {
    if (world.empty()) continue;
    std::vector<ErrorCurve> errors;
    for (const SamplingDrive& drive : world) errors.push_back(drive.errors);
    curves.push_back(MeanCurve(errors, times_s));
  }
  return curves;
}

// When half of the drives that sample a source's cell have done so; none if no drive does.
std::optional<double> MedianSourceTime_s(const std::vector<SamplingDrive>& drives) {
  std::vector<double> times_s;
  for (const SamplingDrive& drive : drives) {
    if (drive.source_s) times_s.push_back(*drive.source_s);
  }
  if (times_s.empty()) return std::nullopt;
  std::sort(times_s.begin(), times_s.end());
  return times_s[(times_s.size() - 1) / 2];
}

// Mean, the ends of its interval, and the dot.
std::vector<Curve> ErrorCurves(const SamplingPlan& plan, const NamedDrives& row,
                               const std::vector<double>& times_s, Rgb color) {
  constexpr double kDash_px = 4.0;
  constexpr double kDot_px = 9.0;
  Curve mean{row.name, {color, 2.0}, {}};
  Curve low{"", {color, 1.2, kDash_px}, {}, CurveKind::kBound};
  Curve high = low;
  Curve source{"", {color, kDot_px}, {}, CurveKind::kDots};
  const std::vector<ErrorCurve> worlds = WorldCurves(plan, row, times_s);
  const std::optional<double> source_s = MedianSourceTime_s(row.drives);
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    std::vector<double> errors_ppm;
    for (const ErrorCurve& world : worlds) errors_ppm.push_back(world[i].rmse_ppm);
    const Spread spread = SpreadOf(errors_ppm);
    const double time_min = times_s[i] / kSecondsPerMinute;
    mean.points.push_back({time_min, spread.mean});
    low.points.push_back({time_min, spread.mean - spread.half_95});
    high.points.push_back({time_min, spread.mean + spread.half_95});
    if (source_s && source.points.empty() && times_s[i] >= *source_s) {
      source.points.push_back(mean.points.back());
    }
  }
  return {low, high, mean, source};
}

double MostOf(const std::vector<Curve>& curves) {
  double most = 0.0;
  for (const Curve& curve : curves) {
    for (const ChartPoint& point : curve.points) {
      if (curve.kind == CurveKind::kLine) most = std::max(most, point.y);
    }
  }
  constexpr double kHeadroom = 1.1;
  return kHeadroom * most;
}

}  // namespace

MapPanel TruthPanel(const Scene& scene) {
  MapPanel panel = GasPanel(scene, scene.conc_mean_ppm, "The truth: mean over time");
  AddSources(scene, panel);
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

absl::StatusOr<TimePictures> PictureTimes(const SamplingPlan& plan, std::size_t row,
                                          std::size_t number, const std::vector<double>& times_s) {
  const Scene& scene = plan.worlds[plan.cases[number].world];
  const double open_ppm2 = OpenLatticeVariance_ppm2(plan.rows[row].mission.gas);
  Progress progress;
  std::optional<Moment> latest;
  TimePictures pictures;
  const auto picture = [&] {
    pictures.means.push_back(UpdatePanel(scene, latest->map, latest->error, latest->progress));
    pictures.variances.push_back(VariancePanel(scene, latest->map, latest->error, open_ppm2));
  };
  SamplingWatch watch;
  watch.on_plan = [&](double, const Plan& made) { TakePlan(made, progress); };
  watch.on_map = [&](const ErrorPoint& error, const MapSnapshot& map) {
    latest = Moment{error, map, progress};
    while (pictures.means.size() < times_s.size() &&
           error.time_s >= times_s[pictures.means.size()]) {
      picture();
    }
  };
  PLUMESCOUT_RETURN_IF_ERROR(RunSamplingCase(plan, row, number, watch).status());
  if (!latest) return absl::InternalError("a drive without a map");
  while (pictures.means.size() < times_s.size()) picture();
  return pictures;
}

MapPanel MomentPanel(const Scene& scene, double time_s) {
  const SceneWorld world(scene);
  Grid<float> gas_ppm(scene.geometry());
  for (std::size_t i = 0; i < gas_ppm.size(); ++i) {
    const Point2 place = scene.geometry().Center(scene.geometry().CellAtIndex(i));
    gas_ppm[i] = static_cast<float>(world.Concentration_ppm(place, time_s));
  }
  return GasPanel(scene, gas_ppm, absl::StrFormat("The gas at %.0f s", time_s));
}

absl::StatusOr<MapPanel> StagePanel(const SamplingPlan& plan, std::size_t row, std::size_t number,
                                    double time_s) {
  const SamplingCase& drive = plan.cases[number];
  const Scene& scene = plan.worlds[drive.world];
  MapPanel panel = MomentPanel(scene, time_s);
  std::vector<Point2> way;
  SamplingWatch watch;
  watch.on_plan = [&](double, const Plan& made) {
    for (const Waypoint& waypoint : made.trajectory.waypoints) {
      way.push_back(waypoint.pose.position());
    }
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const SamplingRecord record,
                              RunSamplingCase(plan, row, number, watch));
  std::vector<Point2> sampled;
  for (const TakenSample& sample : record.samples) sampled.push_back(sample.place);
  panel.lines.push_back({std::move(way), {kPaper, 1.0}});
  AddSites(sampled, kReach * scene.geometry().resolution_m, kPaper, 1.5, panel);
  for (const SamplingCase& other : plan.cases) {
    if (other.world != drive.world) continue;
    panel.marks.push_back({MarkShape::kDisc, kStartColor, other.start.position()});
  }
  AddSources(scene, panel);
  return panel;
}

std::vector<Chart> MakeErrorCharts(const SamplingPlan& plan, const NamedDrives& reference,
                                   const std::vector<NamedDrives>& rows) {
  double end_s = 0.0;
  for (const SamplingDrive& drive : reference.drives) {
    end_s = std::max(end_s, drive.errors.back().time_s);
  }
  for (const NamedDrives& row : rows) {
    for (const SamplingDrive& drive : row.drives) {
      end_s = std::max(end_s, drive.errors.back().time_s);
    }
  }
  constexpr double kSteps = 300.0;
  const std::vector<double> times_s = EvenTimes_s(end_s, std::max(end_s, 1.0) / kSteps);
  const std::vector<Curve> behind = ErrorCurves(plan, reference, times_s, kReferenceColor);
  std::vector<Chart> charts;
  double most_ppm = MostOf(behind);
  for (const NamedDrives& row : rows) {
    Chart& chart = charts.emplace_back(Chart{row.name + ": RMSE, ppm", "time, min", {}, behind});
    NamedDrives shown = row;
    shown.name = "the row";  // one legend for all charts
    for (Curve& curve : ErrorCurves(plan, shown, times_s, kLatestColor)) {
      chart.curves.push_back(std::move(curve));
    }
    most_ppm = std::max(most_ppm, MostOf(chart.curves));
  }
  for (Chart& chart : charts) chart.y_range = Range{0.0, std::max(1e-9, most_ppm)};
  return charts;
}

CsvTable MakeDriveTable(const SamplingPlan& plan,
                        const std::vector<std::vector<SamplingDrive>>& drives) {
  CsvTable table;
  table.label_columns = {"row", "case"};
  table.columns = {"seed",           "distance_m",     "samples",      "elapsed_s",
                   "final_rmse_ppm", "least_rmse_ppm", "least_rmse_s", "convergence_s"};
  AddCalibrationColumns(table);
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
      AddCalibration(drive.calibration, table.rows.back());
    }
  }
  return table;
}

}  // namespace plumescout::lab
