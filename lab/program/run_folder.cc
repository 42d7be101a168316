// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/run_folder.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "formats/map_server.h"
#include "lab/about/about.h"
#include "lab/formats/csv.h"
#include "lab/formats/npy.h"
#include "lab/formats/summary.h"
#include "lab/program/explorer.h"
#include "lab/report/number_labels.h"
#include "lab/report/report.h"
#include "lab/trials/calibration_table.h"
#include "lab/trials/map_calibration.h"
#include "lab/trials/team_picture.h"

namespace plumescout::lab {
namespace {

// Of all robots, in the order of their issue.
std::vector<const IssuedPlan*> PlansOf(const TeamResult& team) {
  std::vector<const IssuedPlan*> plans;
  for (const EpisodeResult& robot : team.robots) {
    for (const IssuedPlan& plan : robot.plans) plans.push_back(&plan);
  }
  std::stable_sort(plans.begin(), plans.end(),
                   [](const auto* a, const auto* b) { return a->plan.id < b->plan.id; });
  return plans;
}

std::vector<double> OfPlans(const TeamResult& team,
                            const std::function<double(const IssuedPlan&)>& figure) {
  std::vector<double> values;
  for (const IssuedPlan* plan : PlansOf(team)) values.push_back(figure(*plan));
  return values;
}

template <typename Figure>
double Sum(const TeamResult& team, Figure figure) {
  double sum = 0.0;
  for (const EpisodeResult& robot : team.robots) sum += static_cast<double>(figure(robot));
  return sum;
}

void AddTeamFigures(const TeamResult& team, Summary& summary) {
  const auto add = [&](const char* name, double value) {
    summary.figures.emplace_back(name, value);
  };
  add("readings_sent", Sum(team, [](const EpisodeResult& r) { return r.readings_sent; }));
  add("readings_applied", Sum(team, [](const EpisodeResult& r) { return r.readings_applied; }));
  add("distance_m", Sum(team, [](const EpisodeResult& r) { return r.distance_m; }));
  add("collisions", Sum(team, [](const EpisodeResult& r) { return r.collisions; }));
  add("mission_complete", IsComplete(team) ? 1.0 : 0.0);
  add("robots", static_cast<double>(team.robots.size()));
  add("closest_m", team.closest_m);
  add("contacts", team.contacts);
  add("legs", Sum(team, [](const EpisodeResult& r) { return r.legs; }));
  add("blocked_legs", Sum(team, [](const EpisodeResult& r) { return r.blocked_legs; }));
}

Summary MakeSummary(const Run& run) {
  const MapMetrics& metrics = run.team.samples.back().metrics;
  constexpr double kMillisecondsPerSecond = 1e3;
  auto cpu_ms =
      OfPlans(run.team, [](const IssuedPlan& p) { return p.plan.cpu_s * kMillisecondsPerSecond; });
  std::erase(cpu_ms, 0.0);  // not said: the planner ran in this process
  const auto wall_ms =
      OfPlans(run.team, [](const IssuedPlan& p) { return absl::ToDoubleMilliseconds(p.rpc_wall); });
  Summary summary;
  summary.figures = {
      {"completeness", metrics.completeness},
      {"rmse_ppm", metrics.rmse_ppm},
      {"rmse_zero_ppm", metrics.rmse_zero_ppm},
      {"entropy_nats", metrics.entropy_nats},
      {"plans", static_cast<double>(PlansOf(run.team).size())},
      {"plan_cpu_ms_p50", Median(cpu_ms)},
      {"plan_rpc_wall_ms_p99", Quantile(wall_ms, 0.99)},
      {"simulated_s", run.team.samples.back().time_s},
      {"wall_s", run.wall_s},
  };
  AddCalibration(Calibrate(run.world.scene(), run.final_map.gas_mean_ppm,
                           run.final_map.gas_variance_ppm2, run.world.ambient_ppm()),
                 "", summary);
  AddTeamFigures(run.team, summary);
  if (run.server_killed_s) summary.figures.emplace_back("server_killed_at_s", *run.server_killed_s);
  summary.about = AboutThisRun(run.seed);
  summary.about.emplace_back("scene", run.world.scene().name);
  summary.about.emplace_back("strategy", run.strategy);
  return summary;
}

CsvTable MakeMetricsTable(const TeamResult& team) {
  CsvTable table{
      {"time_s", "revision", "completeness", "rmse_ppm", "rmse_zero_ppm", "entropy_nats"}, {}};
  for (const MetricSample& sample : team.samples) {
    const MapMetrics& m = sample.metrics;
    table.rows.push_back({sample.time_s, static_cast<double>(sample.revision), m.completeness,
                          m.rmse_ppm, m.rmse_zero_ppm, m.entropy_nats});
  }
  return table;
}

ReportData MakeReport(const Run& run, const Summary& summary) {
  ReportData report;
  report.title = absl::StrCat("Gas leak in ", run.world.scene().name);
  report.true_gas_ppm = run.world.scene().conc_mean_ppm;
  report.truth = run.world.scene().occupancy;
  report.map = run.final_map;
  for (const GasSource& source : run.world.scene().sources) {
    report.sources.push_back({source.x_m, source.y_m});
  }
  for (const IssuedPlan* plan : PlansOf(run.team)) report.plans.push_back(plan->plan);
  for (const EpisodeResult& robot : run.team.robots) {
    std::vector<Point2> path;
    for (const DrivenPose& driven : robot.path) path.push_back(driven.pose.position());
    if (!path.empty()) report.starts.push_back(path.front());
    report.driven_paths.push_back(std::move(path));
  }
  for (const MetricSample& sample : run.team.samples) {
    const MapMetrics& m = sample.metrics;
    report.metrics.push_back(
        {sample.time_s, m.completeness, m.rmse_ppm, m.rmse_zero_ppm, m.entropy_nats});
  }
  if (run.team.robots.size() > 1) report.team = MakeTeamPicture(run.team, run.world, run.look);
  report.objective = run.objective;
  report.server_killed_s = run.server_killed_s;
  report.key_numbers = LabelledNumbers(summary);
  report.explorer = MakeExplorer(ReadExplorerPage(), run);
  return report;
}

absl::Status WriteField(const Grid<float>& field, const std::string& path) {
  const std::size_t shape[] = {static_cast<std::size_t>(field.height()),
                               static_cast<std::size_t>(field.width())};
  return WriteNpy(path, shape, field.values());
}

}  // namespace

absl::Status WriteMapFiles(const MapSnapshot& map, const std::string& folder) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(folder));
  PLUMESCOUT_RETURN_IF_ERROR(WriteMapServer(map.occupancy, absl::StrCat(folder, "/map.yaml")));
  PLUMESCOUT_RETURN_IF_ERROR(WriteField(map.gas_mean_ppm, absl::StrCat(folder, "/gas_mean.npy")));
  for (const GasLayers& gas : map.further_gases) {
    const std::string of = absl::StrCat("_", gas.species, ".npy");
    PLUMESCOUT_RETURN_IF_ERROR(WriteField(gas.mean_ppm, absl::StrCat(folder, "/gas_mean", of)));
    PLUMESCOUT_RETURN_IF_ERROR(
        WriteField(gas.variance_ppm2, absl::StrCat(folder, "/gas_variance", of)));
  }
  return WriteField(map.gas_variance_ppm2, absl::StrCat(folder, "/gas_variance.npy"));
}

absl::Status WriteRunFolder(const Run& run, const std::string& folder) {
  const Summary summary = MakeSummary(run);
  PLUMESCOUT_RETURN_IF_ERROR(WriteMapFiles(run.final_map, folder));
  PLUMESCOUT_RETURN_IF_ERROR(WriteSummary(summary, absl::StrCat(folder, "/summary.json")));
  PLUMESCOUT_RETURN_IF_ERROR(
      WriteCsv(MakeMetricsTable(run.team), absl::StrCat(folder, "/metrics.csv")));
  return WriteReport(MakeReport(run, summary), folder);
}

}  // namespace plumescout::lab
