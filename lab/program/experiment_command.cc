// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/experiment_command.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "lab/program/progress_line.h"
#include "lab/studies/experiments.h"

namespace plumescout::lab {
namespace {

struct ExperimentArguments {
  std::string name;
  std::string out;  // empty: out/NAME
  ExperimentOptions options;
};

constexpr char kAll[] = "all";

absl::Status MakeExperiment(const std::string& name, const std::string& out,
                            ExperimentOptions options) {
  ProgressLine progress(absl::Seconds(2));
  const absl::Time start = absl::Now();
  options.folder = out;
  options.progress = [&](double share) {
    progress.Show(absl::StrCat(ProgressWithTimeLeft(share, absl::Now() - start), "  ", name));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const Study study, RunExperiment(name, options));
  PLUMESCOUT_RETURN_IF_ERROR(WriteStudy(study, out));
  progress.Finish(absl::StrFormat("%s: done in %.1f s", study.figures.title,
                                  absl::ToDoubleSeconds(absl::Now() - start)));
  std::cout << out << "/report.html" << std::endl;
  return absl::OkStatus();
}

absl::Status MakeExperiments(const ExperimentArguments& arguments) {
  const bool all = arguments.name == kAll;
  const std::string out = !arguments.out.empty() ? arguments.out
                          : all                  ? "out"
                                                 : absl::StrCat("out/", arguments.name);
  if (!all) return MakeExperiment(arguments.name, out, arguments.options);
  for (const std::string& name : ExperimentNames()) {
    PLUMESCOUT_RETURN_IF_ERROR(
        MakeExperiment(name, absl::StrCat(out, "/", name), arguments.options));
  }
  return absl::OkStatus();
}

}  // namespace

void AddExperimentCommand(CLI::App& app, absl::Status& status) {
  CLI::App* experiment = app.add_subcommand(
      "experiment", "Make figures and tables of the papers again, and our own: pages and numbers");
  const auto arguments = std::make_shared<ExperimentArguments>();
  ExperimentOptions& options = arguments->options;
  options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::string> names = ExperimentNames();
  names.emplace_back(kAll);
  experiment->add_option("name", arguments->name, "Which one, or all")
      ->required()
      ->check(CLI::IsMember(names));
  experiment->add_option("--out", arguments->out,
                         "Folder for results (default: out/NAME). Studies of many trials keep "
                         "each there, and go on from what they find");
  experiment->add_option("--trials", options.trials, "Trials of each row (default: the paper's)")
      ->check(CLI::PositiveNumber);
  experiment
      ->add_option("--scenes", options.scenes,
                   "Scene folders to study in place of the experiment's own")
      ->check(CLI::ExistingDirectory);
  experiment->add_option("--jobs", options.jobs, "Trials at once")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  experiment->add_option("--seed", options.seed, "Seed of everything drawn at random")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  experiment->add_flag("--quick", options.quick, "Less of everything: all of it in some minutes");
  experiment->callback([arguments, &status] { status = MakeExperiments(*arguments); });
}

}  // namespace plumescout::lab
