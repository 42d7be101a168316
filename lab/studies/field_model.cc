// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/field_model.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/formats/scene_folder.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/gas_recording.h"
#include "lab/trials/map_calibration.h"
#include "lab/trials/recorded_map.h"
#include "lab/trials/statistics.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/task_pool.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kFirstBuilding = 700;  // 720 and on were tuned on
constexpr int kBuildings = 12;
constexpr int kTrials = 3;
constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 30.0;

// How the readings were come by.
struct Driving {
  const char* name;
  const char* strategy;
  bool as_missions_are;  // with the default field and map; else those of [XIT]
};
constexpr Driving kDrivings[] = {{"plumescout", "plumescout", false},
                                 {"xit_f", "xit_f", false},
                                 {"plumescout_default", "plumescout", true}};

struct Model {
  const char* name;
  const char* label;
  bool along_way;
  GasOptions gas;
};

GasOptions Gas(double prior_precision, double background_precision, GasScale scale,
               bool estimate_noise) {
  GasOptions gas = PublishedGasOptions();
  gas.prior_precision_per_ppm2 = prior_precision;
  gas.background_precision_per_ppm2 = background_precision;
  gas.scale = scale;
  gas.estimate_noise = estimate_noise;
  return gas;
}

GasOptions OneScale() {
  GasOptions gas;
  gas.noise_by_level = false;
  return gas;
}

GasOptions Learned(double prior_precision, double background_precision, GasScale scale) {
  GasOptions gas = Gas(prior_precision, background_precision, scale, true);
  gas.precisions = GasPrecisions::kLearned;
  return gas;
}

constexpr std::size_t kBaseline = 0;
std::vector<Model> Models() {
  constexpr GasScale kLinear = GasScale::kLinear;
  constexpr GasScale kRoot = GasScale::kSquareRoot;
  return {{"plain", "points, linear, fixed noise", false, Gas(3.0, 1e-3, kLinear, false)},
          {"noise", "points, linear, noise estimated", false, Gas(3.0, 1e-3, kLinear, true)},
          {"points_root", "points, roots", false, Gas(0.3, 9e-4, kRoot, true)},
          {"way_as_is", "way, linear, precisions as they are", true, Gas(3.0, 1e-3, kLinear, true)},
          // The ratios of (0.3, 9e-4) with lambda_o = 10, so the same means.
          {"way_linear", "way, linear, one scale of noise", true, OneScale()},
          {"way_level", "way, linear, as by default", true, GasOptions{}},
          {"way_root", "way, roots", true, Gas(0.3, 3e-4, kRoot, true)},
          {"learned", "points, linear, learned", false, Learned(3.0, 1e-3, kLinear)},
          {"way_learned", "way, linear, learned", true, Learned(3.0, 1e-3, kLinear)},
          {"root_learned", "points, roots, learned", false, Learned(0.3, 3e-4, kRoot)}};
}

struct Outcome {
  MapCalibration map;
  GasQuality gas;
};

absl::StatusOr<Outcome> MapBy(const Model& model, const Scene& scene,
                              const GasRecording& recording) {
  const auto readings = model.along_way ? AlongWay(recording, model.gas) : AtPoints(recording);
  PLUMESCOUT_ASSIGN_OR_RETURN(const MapSnapshot map, MapRecording(recording, readings, model.gas));
  return Outcome{Calibrate(scene, map.gas_mean_ppm, map.gas_variance_ppm2), map.gas_quality};
}

struct Mission {
  std::string building;
  Driving driving{};
  std::uint64_t seed = 1;
  std::vector<Outcome> models;
};

absl::StatusOr<GasRecording> Drive(const SceneWorld& world, const Driving& driving,
                                   std::uint64_t seed, double duration_s) {
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow row, MakeStudyRow(driving.name, driving.strategy, false));
  if (driving.as_missions_are) row = AsMissionsAre(std::move(row));
  return RecordGas(world, row.mission, seed, duration_s, row.robot.leaves_lag_to_mission);
}

absl::StatusOr<std::vector<Mission>> Record(const ExperimentOptions& options,
                                            const std::vector<std::string>& scenes,
                                            const std::function<void(double)>& progress) {
  const int trials = options.trials.value_or(options.quick ? 1 : kTrials);
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  const std::size_t per_scene = std::size(kDrivings) * static_cast<std::size_t>(trials);
  const std::vector<Model> models = Models();
  std::vector<Mission> missions(scenes.size() * per_scene);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Scene scene, ReadScene(scenes[s]));
    const SceneWorld world(std::move(scene));
    const auto run = [&](std::size_t task) -> absl::Status {
      Mission& mission = missions[s * per_scene + task];
      mission.building = SceneName(scenes[s]);
      mission.driving = kDrivings[task % std::size(kDrivings)];
      mission.seed = options.seed + task / std::size(kDrivings);
      PLUMESCOUT_ASSIGN_OR_RETURN(const GasRecording recording,
                                  Drive(world, mission.driving, mission.seed, duration_s));
      for (const Model& model : models) {
        PLUMESCOUT_ASSIGN_OR_RETURN(const Outcome outcome, MapBy(model, world.scene(), recording));
        mission.models.push_back(outcome);
      }
      return absl::OkStatus();
    };
    PLUMESCOUT_RETURN_IF_ERROR(RunTasks(per_scene, options.jobs, run, [&](double share) {
      progress((static_cast<double>(s) + share) / static_cast<double>(scenes.size()));
    }));
  }
  return missions;
}

using FigureFn = double (*)(const Outcome& model, const Outcome& baseline);
struct Figure {
  const char* name;
  const char* label;
  FigureFn of;
};
constexpr Figure kFigures[] = {
    {"rmse_ratio", "RMSE over that of the first",
     [](const Outcome& m, const Outcome& b) { return m.map.rmse_ppm / b.map.rmse_ppm; }},
    {"log_ratio", "log error over that of the first",
     [](const Outcome& m, const Outcome& b) { return m.map.log_rmse / b.map.log_rmse; }},
    {"log_all_ratio", "the same in all free cells",
     [](const Outcome& m, const Outcome& b) { return m.map.log_rmse_all / b.map.log_rmse_all; }},
    {"nlpd", "NLPD, nats", [](const Outcome& m, const Outcome&) { return m.map.nlpd_nats; }},
    {"within_1_sigma", "1 σ holds",
     [](const Outcome& m, const Outcome&) { return m.map.within_1_sigma; }},
    {"within_2_sigma", "2 σ holds",
     [](const Outcome& m, const Outcome&) { return m.map.within_2_sigma; }},
    {"rms_z", "rms z", [](const Outcome& m, const Outcome&) { return m.map.rms_z; }},
    {"two_sigma_fits", "missions with 2 σ in 0.90–0.98",
     [](const Outcome& m, const Outcome&) {
       return m.map.within_2_sigma >= 0.9 && m.map.within_2_sigma <= 0.98 ? 1.0 : 0.0;
     }},
    {"z_fits", "with rms z in 0.7–1.5",
     [](const Outcome& m, const Outcome&) {
       return m.map.rms_z >= 0.7 && m.map.rms_z <= 1.5 ? 1.0 : 0.0;
     }},
};

// By building, as means over its missions.
std::vector<double> ByBuilding(const std::vector<Mission>& missions, std::size_t model,
                               FigureFn figure) {
  std::vector<double> means;
  for (std::size_t i = 0; i < missions.size();) {
    double sum = 0.0;
    std::size_t end = i;
    while (end < missions.size() && missions[end].building == missions[i].building) {
      sum += figure(missions[end].models[model], missions[end].models[kBaseline]);
      ++end;
    }
    means.push_back(sum / static_cast<double>(end - i));
    i = end;
  }
  return means;
}

// Of the missions that were driven as missions are, or of the others.
TextTable MakeTable(std::vector<Mission> missions, bool as_missions_are, Summary& summary) {
  std::erase_if(missions,
                [&](const Mission& m) { return m.driving.as_missions_are != as_missions_are; });
  const char* const prefix = as_missions_are ? "default_" : "";
  TextTable table;
  table.title = absl::StrCat("Means over buildings [± 95 % interval], critical cells; missions of ",
                             as_missions_are ? "plumescout as they are by default"
                                             : "plumescout and xit_f in the field of [XIT]");
  table.columns = {"model"};
  for (const Figure& figure : kFigures) table.columns.emplace_back(figure.label);
  table.columns.emplace_back("RMSE ratio, worst building");
  const std::vector<Model> models = Models();
  for (std::size_t m = 0; m < models.size(); ++m) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.emplace_back(models[m].label);
    for (const Figure& figure : kFigures) {
      const Spread spread = SpreadOf(ByBuilding(missions, m, figure.of));
      row.push_back(absl::StrFormat("%.3f [± %.3f]", spread.mean, spread.half_95));
      summary.figures.emplace_back(absl::StrCat(prefix, models[m].name, "_", figure.name),
                                   spread.mean);
    }
    const std::vector<double> ratios = ByBuilding(missions, m, kFigures[0].of);
    const double worst = *std::max_element(ratios.begin(), ratios.end());
    row.push_back(absl::StrFormat("%.3f", worst));
    summary.figures.emplace_back(absl::StrCat(prefix, models[m].name, "_rmse_ratio_worst"), worst);
  }
  return table;
}

CsvTable MakeCsv(const std::vector<Mission>& missions) {
  CsvTable csv;
  csv.label_columns = {"building", "strategy", "model"};
  csv.columns = {"seed",
                 "rmse_ppm",
                 "log_rmse",
                 "log_rmse_all",
                 "nlpd_nats",
                 "within_1_sigma",
                 "within_2_sigma",
                 "rms_z",
                 "noise_scale",
                 "prior_precision_scale",
                 "prior_precision_log_stddev"};
  const std::vector<Model> models = Models();
  for (const Mission& mission : missions) {
    for (std::size_t m = 0; m < models.size(); ++m) {
      const auto& [map, gas] = mission.models[m];
      csv.labels.push_back({mission.building, mission.driving.name, models[m].name});
      csv.rows.push_back({static_cast<double>(mission.seed), map.rmse_ppm, map.log_rmse,
                          map.log_rmse_all, map.nlpd_nats, map.within_1_sigma, map.within_2_sigma,
                          map.rms_z, gas.noise_scale, gas.prior_precision_scale,
                          gas.prior_precision_log_stddev});
    }
  }
  return csv;
}

}  // namespace

absl::StatusOr<Study> RunFieldModel(const ExperimentOptions& options) {
  constexpr double kScenesShare = 0.3;  // of the time, for the progress line
  ExperimentOptions making = options;
  making.progress = PartOfProgress(options, 0.0, kScenesShare);
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const std::vector<std::string> scenes,
      GeneratedScenes(making, {kFirstBuilding, options.quick ? 1 : kBuildings}, duration_s));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Mission> missions,
                              Record(options, scenes, PartOfProgress(options, kScenesShare, 1.0)));
  Study study;
  study.figures.title = "Models of the gas field, from the same readings";
  study.figures.notes = {
      absl::StrFormat("%d missions of %.0f s in %d buildings. Every model has the same readings, "
                      "with the lag of the sensor; the truth is the mean over time.",
                      missions.size(), duration_s, scenes.size()),
      "Points: the lag is undone from each two readings, for one place between them. Way: along "
      "the "
      "way, for each cell that was passed. Roots: the square root of the concentration is "
      "Gaussian."};
  study.figures.tables = {MakeTable(missions, false, study.summary),
                          MakeTable(missions, true, study.summary)};
  study.table = MakeCsv(missions);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
