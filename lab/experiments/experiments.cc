// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/experiments/experiments.h"

#include <array>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "lab/experiments/gas_validation.h"
#include "lab/experiments/mit_table1.h"
#include "lab/experiments/xit_fig3.h"
#include "lab/experiments/xit_fig4.h"
#include "lab/experiments/xit_fig5.h"

namespace plumescout::lab {
namespace {

struct Experiment {
  const char* name;
  absl::StatusOr<Study> (*run)(const ExperimentOptions&);
};

// An experiment that cannot fail, as one that can.
template <Study (*Run)(const ExperimentOptions&)>
absl::StatusOr<Study> Sure(const ExperimentOptions& options) {
  return Run(options);
}

constexpr std::array<Experiment, 5> kExperiments = {{
    {"gas_validation", RunGasValidation},
    {"mit_table1", Sure<RunMitTable1>},
    {"xit_fig3", Sure<RunXitFig3>},
    {"xit_fig4", Sure<RunXitFig4>},
    {"xit_fig5", Sure<RunXitFig5>},
}};

}  // namespace

std::vector<std::string> ExperimentNames() {
  std::vector<std::string> names;
  for (const Experiment& experiment : kExperiments) names.emplace_back(experiment.name);
  return names;
}

absl::StatusOr<Study> RunExperiment(const std::string& name, const ExperimentOptions& options) {
  for (const Experiment& experiment : kExperiments) {
    if (name == experiment.name) return experiment.run(options);
  }
  return absl::InvalidArgumentError(absl::StrCat("no experiment \"", name, "\"; there are ",
                                                 absl::StrJoin(ExperimentNames(), ", ")));
}

}  // namespace plumescout::lab
