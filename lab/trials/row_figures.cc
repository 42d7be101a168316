// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/row_figures.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "lab/formats/scene_folder.h"
#include "lab/trials/oracle.h"
#include "lab/trials/task_pool.h"

namespace plumescout::lab {
namespace {

constexpr double kCurveWidth_px = 1.8;
constexpr double kBandWidth_px = 1.2;
constexpr double kBandDash_px = 4.0;

// When samples were taken, by the trial that went on longest.
std::vector<double> SampleTimes_s(const std::vector<SceneRecords>& records) {
  std::vector<double> times_s;
  for (const SceneRecords& scene : records) {
    for (const auto& trials : scene) {
      for (const TrialRecord& trial : trials) {
        if (trial.curve.size() <= times_s.size()) continue;
        times_s.clear();
        for (const CurvePoint& point : trial.curve) times_s.push_back(point.time_s);
      }
    }
  }
  return times_s;
}

// At sample `index`.
Spread SpreadAt(const std::vector<SceneRecords>& records, std::size_t row, std::size_t index,
                MetricFn metric) {
  return SpreadOf(UnitsOf(records, row, [&](const TrialRecord& trial) {
    return metric(trial.curve[std::min(index, trial.curve.size() - 1)].metrics);
  }));
}

}  // namespace

double Rmse_ppm(const MapMetrics& metrics) { return metrics.rmse_ppm; }
double Entropy_nats(const MapMetrics& metrics) { return metrics.entropy_nats; }
double EntropyPerCell_nats(const MapMetrics& metrics) {
  return metrics.entropy_nats / metrics.critical_cells;
}
double Completeness(const MapMetrics& metrics) { return metrics.completeness; }

std::vector<double> UnitsOf(const std::vector<SceneRecords>& records, std::size_t row,
                            const std::function<double(const TrialRecord&)>& value) {
  std::vector<double> units;
  for (const SceneRecords& scene : records) {
    std::vector<double> trials;
    for (const TrialRecord& trial : scene[row]) trials.push_back(value(trial));
    if (records.size() == 1) return trials;
    units.push_back(SpreadOf(trials).mean);
  }
  return units;
}

std::vector<double> Finals(const std::vector<SceneRecords>& records, std::size_t row,
                           MetricFn metric) {
  return UnitsOf(records, row,
                 [metric](const TrialRecord& trial) { return metric(trial.curve.back().metrics); });
}

Chart MakeMetricChart(const std::vector<SceneRecords>& records, const std::vector<RowStyle>& rows,
                      const std::string& title, MetricFn metric) {
  Chart chart{title, "time, s", std::nullopt, {}};
  if (metric == Completeness) chart.y_range = Range{0.0, 1.0};  // a share
  const std::vector<double> times_s = SampleTimes_s(records);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Curve mean{rows[row].name, {rows[row].color, kCurveWidth_px}, {}};
    Curve low{"", {rows[row].color, kBandWidth_px, kBandDash_px}, {}, CurveKind::kBound};
    Curve high = low;
    for (std::size_t i = 0; i < times_s.size(); ++i) {
      const Spread spread = SpreadAt(records, row, i, metric);
      mean.points.push_back({times_s[i], spread.mean});
      low.points.push_back({times_s[i], spread.mean - spread.half_95});
      high.points.push_back({times_s[i], spread.mean + spread.half_95});
    }
    if (rows[row].with_band) chart.curves.insert(chart.curves.end(), {low, high});
    chart.curves.push_back(std::move(mean));
  }
  return chart;
}

absl::StatusOr<std::vector<MapMetrics>> OracleMetrics(const TrialPlan& plan,
                                                      const std::vector<SceneRecords>& records,
                                                      std::size_t row,
                                                      const std::function<void(double)>& progress) {
  std::vector<MapMetrics> oracles(records.size());
  const auto judge = [&](std::size_t i) -> absl::Status {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, ReadScene(plan.scenes[i]));
    const int readings = records[i][row].front().gas_readings;
    PLUMESCOUT_ASSIGN_OR_RETURN(oracles[i], PlaceReadings(scene, plan.rows.front().mission.gas,
                                                          readings, OracleAim::kEntropy));
    return absl::OkStatus();
  };
  PLUMESCOUT_RETURN_IF_ERROR(RunTasks(records.size(), plan.jobs, judge, progress));
  return oracles;
}

std::vector<RowMaps> FinalMaps(const TrialPlan& plan, const std::vector<SceneRecords>& records,
                               const std::string& prefix) {
  std::vector<RowMaps> rows;
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    RowMaps& of_row = rows.emplace_back(RowMaps{absl::StrCat(prefix, plan.rows[row].name), {}});
    for (const SceneRecords& scene : records) {
      for (const TrialRecord& trial : scene[row]) of_row.maps.push_back(trial.calibration);
    }
  }
  return rows;
}

CsvTable MakeTrialTable(const TrialPlan& plan, const std::vector<SceneRecords>& records) {
  CsvTable table;
  table.label_columns = {"scene", "row"};
  table.columns = {"seed",           "rmse_ppm",     "rmse_zero_ppm", "entropy_nats",
                   "critical_cells", "completeness", "gas_readings",  "distance_m",
                   "plans",          "collisions",   "completed"};
  AddCalibrationColumns(table);
  for (std::size_t scene = 0; scene < records.size(); ++scene) {
    for (std::size_t row = 0; row < plan.rows.size(); ++row) {
      for (std::size_t k = 0; k < records[scene][row].size(); ++k) {
        const TrialRecord& trial = records[scene][row][k];
        const MapMetrics& m = trial.curve.back().metrics;
        table.labels.push_back({SceneName(plan.scenes[scene]), plan.rows[row].name});
        table.rows.push_back({static_cast<double>(plan.first_seed + k), m.rmse_ppm, m.rmse_zero_ppm,
                              m.entropy_nats, static_cast<double>(m.critical_cells), m.completeness,
                              static_cast<double>(trial.gas_readings), trial.distance_m,
                              static_cast<double>(trial.plans),
                              static_cast<double>(trial.collisions), trial.completed ? 1.0 : 0.0});
        AddCalibration(trial.calibration, table.rows.back());
      }
    }
  }
  return table;
}

}  // namespace plumescout::lab
