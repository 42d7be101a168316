// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/sampling_study.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/prior_map.h"
#include "core/types/status_macros.h"
#include "formats/crc32c.h"
#include "formats/file_io.h"
#include "lab/local/local_planner_client.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/calibration_json.h"
#include "lab/trials/task_pool.h"
#include "lab/trials/trial_store.h"
#include "ompl_planners/ompl_planner.h"
#include "proto/convert/options.h"

namespace plumescout::lab {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxDriveBytes = 16ULL << 20U;

MissionOptions MissionFor(const SamplingPlan& plan, std::size_t row, std::size_t number) {
  MissionOptions mission = plan.rows[row].mission;
  const SamplingCase& drive = plan.cases[number];
  mission.seed = drive.seed;
  StartWith(std::make_shared<const Grid<CellState>>(plan.worlds[drive.world].occupancy), mission);
  return mission;
}

// Tells drives apart: mission with its map, gas, start, noise and times.
std::string FingerprintOf(const SamplingPlan& plan, const MissionOptions& mission,
                          const SamplingCase& drive) {
  return absl::StrFormat(
      "mission %08x scene %08x start %g %g seed %d noise %g %g %g %g first %g limit %g judge %g",
      Crc32c(ToProto(mission).SerializeAsString()), SceneChecksum(plan.worlds[drive.world]),
      drive.start.x_m, drive.start.y_m, drive.seed, plan.noise.sigma_ppm, plan.noise.share,
      plan.noise.variance_per_ppm, plan.noise.least_told_ppm2, plan.first_dwell_s,
      plan.time_limit_s, plan.judge_period_s);
}

std::optional<SamplingDrive> FindDrive(const std::string& file, const std::string& fingerprint) {
  const auto text = ReadFile(file, kMaxDriveBytes);
  if (!text.ok()) return std::nullopt;
  try {
    const json value = json::parse(*text);
    if (value.at("fingerprint").get<std::string>() != fingerprint) return std::nullopt;
    SamplingDrive drive;
    drive.end = static_cast<SamplingEnd>(value.at("end").get<int>());
    drive.elapsed_s = value.at("elapsed_s").get<double>();
    drive.driven_m = value.at("driven_m").get<double>();
    drive.samples = value.at("samples").get<int>();
    const json& source_s = value.at("source_s");
    if (!source_s.is_null()) drive.source_s = source_s.get<double>();
    for (const json& point : value.at("errors")) {
      drive.errors.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
    }
    drive.calibration = CalibrationFrom(value.at("calibration"));
    return drive;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

absl::Status KeepDrive(const std::string& file, const std::string& fingerprint,
                       const SamplingDrive& drive) {
  json value = {{"fingerprint", fingerprint},
                {"end", static_cast<int>(drive.end)},
                {"elapsed_s", drive.elapsed_s},
                {"driven_m", drive.driven_m},
                {"samples", drive.samples},
                {"errors", json::array()},
                {"calibration", ToJson(drive.calibration)}};
  value["source_s"] = drive.source_s ? json(*drive.source_s) : json();
  for (const ErrorPoint& point : drive.errors) {
    value["errors"].push_back({point.time_s, point.rmse_ppm});
  }
  return WriteFile(file, value.dump());
}

std::optional<double> SourceTime_s(const Scene& scene, const std::vector<TakenSample>& samples) {
  const auto at_source = [&scene](const TakenSample& sample) {
    const Cell cell = scene.geometry().CellAt(sample.place);
    return std::any_of(scene.sources.begin(), scene.sources.end(), [&](const GasSource& source) {
      return scene.geometry().CellAt({source.x_m, source.y_m}) == cell;
    });
  };
  const auto first = std::find_if(samples.begin(), samples.end(), at_source);
  if (first == samples.end()) return std::nullopt;
  return first->time_s;
}

absl::StatusOr<SamplingDrive> MakeDrive(const SamplingPlan& plan, std::size_t row,
                                        std::size_t number) {
  const std::string name = absl::StrCat(plan.rows[row].name, "-", plan.cases[number].name);
  const std::string file = absl::StrCat(plan.folder, "/", name, ".json");
  const std::string fingerprint =
      FingerprintOf(plan, MissionFor(plan, row, number), plan.cases[number]);
  if (std::optional<SamplingDrive> kept = FindDrive(file, fingerprint)) return *std::move(kept);
  MapSnapshot map;  // the last
  const SamplingWatch watch{
      .on_plan = nullptr,
      .on_map = [&map](const ErrorPoint&, const MapSnapshot& judged) { map = judged; }};
  auto record = RunSamplingCase(plan, row, number, watch);
  if (!record.ok()) {
    return absl::Status(record.status().code(),
                        absl::StrCat(name, ": ", record.status().message()));
  }
  const Scene& scene = plan.worlds[plan.cases[number].world];
  SamplingDrive drive{record->end,
                      record->elapsed_s,
                      record->driven_m,
                      static_cast<int>(record->samples.size()),
                      SourceTime_s(scene, record->samples),
                      std::move(record->errors),
                      Calibrate(scene, map.gas_mean_ppm, map.gas_variance_ppm2)};
  PLUMESCOUT_RETURN_IF_ERROR(KeepDrive(file, fingerprint, drive));
  return drive;
}

}  // namespace

std::vector<std::vector<SamplingDrive>> ByWorld(const SamplingPlan& plan,
                                                const std::vector<SamplingDrive>& row) {
  std::vector<std::vector<SamplingDrive>> worlds(plan.worlds.size());
  for (std::size_t i = 0; i < row.size(); ++i) worlds[plan.cases[i].world].push_back(row[i]);
  return worlds;
}

std::vector<double> MeansByWorld(const SamplingPlan& plan, const std::vector<SamplingDrive>& row,
                                 const std::function<double(const SamplingDrive&)>& figure) {
  std::vector<double> means;
  for (const std::vector<SamplingDrive>& world : ByWorld(plan, row)) {
    if (world.empty()) continue;
    double sum = 0.0;
    for (const SamplingDrive& drive : world) sum += figure(drive);
    means.push_back(sum / static_cast<double>(world.size()));
  }
  return means;
}

std::vector<RowMaps> FinalMaps(const SamplingPlan& plan,
                               const std::vector<std::vector<SamplingDrive>>& drives) {
  std::vector<RowMaps> rows;
  for (std::size_t row = 0; row < drives.size(); ++row) {
    RowMaps& of_row = rows.emplace_back(RowMaps{plan.rows[row].name, {}});
    for (const SamplingDrive& drive : drives[row]) of_row.maps.push_back(drive.calibration);
  }
  return rows;
}

absl::StatusOr<SamplingRecord> RunSamplingCase(const SamplingPlan& plan, std::size_t row,
                                               std::size_t number, const SamplingWatch& watch) {
  const SamplingCase& drive = plan.cases[number];
  LocalOptions local;
  local.path_planners = MakeOmplPlanner;
  LocalPlannerClient planner(local);
  SamplingRunOptions options;
  options.participation = {
      .mission = "drive", .robot = "robot-1", .create = MissionFor(plan, row, number)};
  options.start = drive.start;
  options.first_dwell_s = plan.first_dwell_s;
  options.time_limit_s = plan.time_limit_s;
  options.judge_period_s = plan.judge_period_s;
  options.seed = drive.seed;
  options.on_plan = watch.on_plan;
  options.on_map = watch.on_map;
  const SceneWorld world(plan.worlds[drive.world]);
  return RunSampling(planner, world.scene(), MakeDwellSensor(world, plan.noise), options);
}

absl::StatusOr<std::vector<std::vector<SamplingDrive>>> RunSamplingStudy(const SamplingPlan& plan) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(plan.folder));
  const std::size_t rows = plan.rows.size();
  std::vector<std::vector<SamplingDrive>> drives(rows,
                                                 std::vector<SamplingDrive>(plan.cases.size()));
  // All rows of a case come before the next case, so that a study that is broken off has pairs.
  PLUMESCOUT_RETURN_IF_ERROR(RunTasks(
      rows * plan.cases.size(), plan.jobs,
      [&](std::size_t task) -> absl::Status {
        PLUMESCOUT_ASSIGN_OR_RETURN(drives[task % rows][task / rows],
                                    MakeDrive(plan, task % rows, task / rows));
        return absl::OkStatus();
      },
      plan.progress));
  return drives;
}

}  // namespace plumescout::lab
