// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// What can be run, by name: figures and tables of the papers ("xit_table3"), our own studies, and
// checks of the simulated world.
std::vector<std::string> ExperimentNames();

// Those that "all" stands for: every one but the studies of teams, which take an hour or more.
std::vector<std::string> ExperimentsOfAll();

// Same options, same values, however many jobs. Errors: kInvalidArgument for an unknown name or
// options out of range; those of the files in options.scenes and options.folder.
absl::StatusOr<Study> RunExperiment(const std::string& name, const ExperimentOptions& options);

}  // namespace plumescout::lab
