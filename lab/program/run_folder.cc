// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/run_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "formats/csv.h"
#include "formats/map_server.h"
#include "formats/npy.h"
#include "formats/summary.h"
#include "lab/bench/about.h"
#include "lab/report/report.h"

namespace plumescout::lab {
namespace {

// The value that `share` of the values do not exceed; NaN if there are none.
double Percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())) -
                                             (share > 0.0 ? 1.0 : 0.0));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

std::vector<double> OfPlans(const EpisodeResult& episode,
                            const std::function<double(const IssuedPlan&)>& figure) {
  std::vector<double> values;
  for (const IssuedPlan& plan : episode.plans) values.push_back(figure(plan));
  return values;
}

Summary MakeSummary(const Run& run) {
  const MapMetrics& metrics = run.episode.samples.back().metrics;
  constexpr double kMillisecondsPerSecond = 1e3;
  auto cpu_ms = OfPlans(run.episode,
                        [](const IssuedPlan& p) { return p.plan.cpu_s * kMillisecondsPerSecond; });
  std::erase(cpu_ms, 0.0);  // not said: the planner ran in this process
  const auto wall_ms = OfPlans(
      run.episode, [](const IssuedPlan& p) { return absl::ToDoubleMilliseconds(p.rpc_wall); });
  Summary summary;
  summary.figures = {
      {"completeness", metrics.completeness},
      {"rmse_ppm", metrics.rmse_ppm},
      {"rmse_zero_ppm", metrics.rmse_zero_ppm},
      {"entropy_nats", metrics.entropy_nats},
      {"plans", static_cast<double>(run.episode.plans.size())},
      {"plan_cpu_ms_p50", Percentile(cpu_ms, 0.5)},
      {"plan_rpc_wall_ms_p99", Percentile(wall_ms, 0.99)},
      {"simulated_s", run.episode.simulated_s},
      {"wall_s", run.wall_s},
      {"readings_sent", static_cast<double>(run.episode.readings_sent)},
      {"readings_applied", static_cast<double>(run.episode.readings_applied)},
      {"distance_m", run.episode.distance_m},
      {"collisions", static_cast<double>(run.episode.collisions)},
      {"mission_complete", run.episode.completed ? 1.0 : 0.0},
  };
  summary.about = AboutThisRun(run.seed);
  summary.about.emplace_back("scene", run.scene.name);
  summary.about.emplace_back("strategy", run.strategy);
  return summary;
}

CsvTable MakeMetricsTable(const EpisodeResult& episode) {
  CsvTable table{
      {"time_s", "revision", "completeness", "rmse_ppm", "rmse_zero_ppm", "entropy_nats"}, {}};
  for (const MetricSample& sample : episode.samples) {
    const MapMetrics& m = sample.metrics;
    table.rows.push_back({sample.time_s, static_cast<double>(sample.revision), m.completeness,
                          m.rmse_ppm, m.rmse_zero_ppm, m.entropy_nats});
  }
  return table;
}

ReportData MakeReport(const Run& run, const Summary& summary) {
  ReportData report;
  report.title = absl::StrCat("Gas leak in ", run.scene.name);
  report.true_gas_ppm = run.scene.conc_mean_ppm;
  report.truth = run.scene.occupancy;
  report.map = run.final_map;
  for (const GasSource& source : run.scene.sources) {
    report.sources.push_back({source.x_m, source.y_m});
  }
  report.starts = {run.scene.start_pose.position()};
  for (const IssuedPlan& plan : run.episode.plans) report.plans.push_back(plan.plan);
  std::vector<Point2> path;
  for (const DrivenPose& driven : run.episode.path) path.push_back(driven.pose.position());
  report.driven_paths = {std::move(path)};
  for (const MetricSample& sample : run.episode.samples) {
    const MapMetrics& m = sample.metrics;
    report.metrics.push_back(
        {sample.time_s, m.completeness, m.rmse_ppm, m.rmse_zero_ppm, m.entropy_nats});
  }
  for (const auto& [name, value] : summary.figures) {
    if (std::isfinite(value)) {
      report.key_numbers.emplace_back(name, absl::StrFormat("%.5g", value));
    }
  }
  for (const auto& [name, value] : summary.about) report.key_numbers.emplace_back(name, value);
  return report;
}

absl::Status WriteField(const Grid<float>& field, const std::string& path) {
  const std::size_t shape[] = {static_cast<std::size_t>(field.height()),
                               static_cast<std::size_t>(field.width())};
  return WriteNpy(path, shape, field.values());
}

}  // namespace

absl::Status WriteRunFolder(const Run& run, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return absl::UnavailableError(absl::StrCat("cannot make ", folder, ": ", error.message()));
  }
  const auto in_folder = [&](const char* name) { return absl::StrCat(folder, "/", name); };
  const Summary summary = MakeSummary(run);
  PLUMESCOUT_RETURN_IF_ERROR(WriteSummary(summary, in_folder("summary.json")));
  PLUMESCOUT_RETURN_IF_ERROR(WriteCsv(MakeMetricsTable(run.episode), in_folder("metrics.csv")));
  PLUMESCOUT_RETURN_IF_ERROR(WriteMapServer(run.final_map.occupancy, in_folder("map.yaml")));
  PLUMESCOUT_RETURN_IF_ERROR(WriteField(run.final_map.gas_mean_ppm, in_folder("gas_mean.npy")));
  PLUMESCOUT_RETURN_IF_ERROR(
      WriteField(run.final_map.gas_variance_ppm2, in_folder("gas_variance.npy")));
  return WriteReport(MakeReport(run, summary), folder);
}

}  // namespace plumescout::lab
