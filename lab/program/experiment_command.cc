// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/experiment_command.h"

#include <iostream>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "lab/experiments/experiments.h"
#include "lab/program/progress_line.h"

namespace plumescout::lab {
namespace {

struct ExperimentArguments {
  std::string name;
  std::string out;  // empty: out/NAME
  ExperimentOptions options;
};

absl::Status MakeExperiment(const ExperimentArguments& arguments) {
  ProgressLine progress(absl::Seconds(2));
  const absl::Time start = absl::Now();
  ExperimentOptions options = arguments.options;
  options.progress = [&](double share) {
    progress.Show(
        absl::StrCat(ProgressWithTimeLeft(share, absl::Now() - start), "  ", arguments.name));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const Study study, RunExperiment(arguments.name, options));
  const std::string out =
      arguments.out.empty() ? absl::StrCat("out/", arguments.name) : arguments.out;
  PLUMESCOUT_RETURN_IF_ERROR(WriteStudy(study, out));
  progress.Finish(absl::StrFormat("%s: done in %.1f s", study.figures.title,
                                  absl::ToDoubleSeconds(absl::Now() - start)));
  std::cout << out << "/report.html\n";
  return absl::OkStatus();
}

}  // namespace

void AddExperimentCommand(CLI::App& app, absl::Status& status) {
  CLI::App* experiment =
      app.add_subcommand("experiment", "Make a figure of the papers again: pictures and numbers");
  const auto arguments = std::make_shared<ExperimentArguments>();
  experiment->add_option("name", arguments->name, "Which figure")
      ->required()
      ->check(CLI::IsMember(ExperimentNames()));
  experiment->add_option("--out", arguments->out, "Folder for results (default: out/NAME)");
  experiment->add_option("--seed", arguments->options.seed, "Seed of everything drawn at random")
      ->capture_default_str();
  experiment->add_option("--scenes", arguments->options.scenes, "Scene folders to look at, too");
  experiment->add_flag("--quick", arguments->options.quick, "Fewer points and runs");
  experiment->callback([arguments, &status] { status = MakeExperiment(*arguments); });
}

}  // namespace plumescout::lab
