// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/experiments.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "lab/studies/all_strategies.h"
#include "lab/studies/cluster_model.h"
#include "lab/studies/field_model.h"
#include "lab/studies/gas_validation.h"
#include "lab/studies/ipp_table1.h"
#include "lab/studies/lhr_calibration.h"
#include "lab/studies/lhr_table2.h"
#include "lab/studies/mit_table1.h"
#include "lab/studies/objectives.h"
#include "lab/studies/own_strategy.h"
#include "lab/studies/team_rivals.h"
#include "lab/studies/team_study.h"
#include "lab/studies/wind_validation.h"
#include "lab/studies/xit_calibration.h"
#include "lab/studies/xit_episode.h"
#include "lab/studies/xit_fig3.h"
#include "lab/studies/xit_fig4.h"
#include "lab/studies/xit_fig5.h"
#include "lab/studies/xit_table3.h"
#include "lab/studies/xit_trial.h"

namespace plumescout::lab {
namespace {

struct Experiment {
  const char* name;
  absl::StatusOr<Study> (*run)(const ExperimentOptions&);
  bool by_name_alone = false;  // takes long, and is no table or figure of a paper
};

constexpr Experiment kExperiments[] = {
    {"all_strategies", RunAllStrategies},
    {"cluster_model", RunClusterModel},
    {"field_model", RunFieldModel},
    {"gas_validation", RunGasValidation},
    {"ipp_table1", RunIppTable1},
    {"lhr_calibration", RunLhrCalibration, true},
    {"lhr_table2", RunLhrTable2},
    {"mit_table1", RunMitTable1},
    {"objectives", RunObjectives},
    {"own_strategy", RunOwnStrategy},
    {"team_rivals", RunTeamRivals, true},
    {"team_study", RunTeamStudy, true},
    {"wind_validation", RunWindValidation},
    {"xit_calibration", RunXitCalibration},
    {"xit_episode", RunXitEpisode},
    {"xit_fig3", RunXitFig3},
    {"xit_fig4", RunXitFig4},
    {"xit_fig5", RunXitFig5},
    {"xit_table3", RunXitTable3},
    {"xit_trial", RunXitTrial},
};

absl::Status Validate(const ExperimentOptions& options) {
  return Checker()
      .AtLeast("trials", options.trials.value_or(1), 1)
      .AtLeast("jobs", options.jobs, 1)
      .status();
}

}  // namespace

std::vector<std::string> ExperimentNames() {
  std::vector<std::string> names;
  for (const Experiment& experiment : kExperiments) names.emplace_back(experiment.name);
  return names;
}

std::vector<std::string> ExperimentsOfAll() {
  std::vector<std::string> names;
  for (const Experiment& experiment : kExperiments) {
    if (!experiment.by_name_alone) names.emplace_back(experiment.name);
  }
  return names;
}

absl::StatusOr<Study> RunExperiment(const std::string& name, const ExperimentOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  for (const Experiment& experiment : kExperiments) {
    if (name == experiment.name) return experiment.run(options);
  }
  return absl::InvalidArgumentError(absl::StrCat("no experiment \"", name, "\"; there are ",
                                                 absl::StrJoin(ExperimentNames(), ", ")));
}

}  // namespace plumescout::lab
