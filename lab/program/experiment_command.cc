// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/experiment_command.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
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
  std::string out;      // empty: out/NAME
  std::string summary;  // empty: none but summary.json of the folder
  ExperimentOptions options;
};

constexpr char kAll[] = "all";

// The summary of what was found.
absl::StatusOr<Summary> MakeExperiment(const std::string& name, const std::string& out,
                                       ExperimentOptions options) {
  ProgressLine progress(absl::Seconds(2));
  const absl::Time start = absl::Now();
  options.folder = out;
  options.progress = [&](double share) {
    progress.Show(absl::StrCat(ProgressWithTimeLeft(share, absl::Now() - start), "  ", name));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(Study study, RunExperiment(name, options));
  study.summary.figures.emplace_back("wall_s", absl::ToDoubleSeconds(absl::Now() - start));
  PLUMESCOUT_RETURN_IF_ERROR(WriteStudy(study, out));
  progress.Finish(absl::StrFormat("%s: done in %.1f s", study.figures.title,
                                  absl::ToDoubleSeconds(absl::Now() - start)));
  std::cout << out << "/report.html" << std::endl;
  return std::move(study.summary);
}

// Figures of many experiments in one object: "xit_fig3_shortest_m".
void Append(const Summary& summary, const std::string& name, Summary& all) {
  for (const auto& [figure, value] : summary.figures) {
    all.figures.emplace_back(absl::StrCat(name, "_", figure), value);
  }
  for (const auto& [what, text] : summary.about) {
    all.about.emplace_back(absl::StrCat(name, "_", what), text);
  }
}

absl::Status MakeExperiments(const ExperimentArguments& arguments) {
  const bool all = arguments.name == kAll;
  const std::string out = !arguments.out.empty() ? arguments.out
                          : all                  ? "out"
                                                 : absl::StrCat("out/", arguments.name);
  Summary summary;
  if (all) {
    for (const std::string& name : ExperimentsOfAll()) {
      PLUMESCOUT_ASSIGN_OR_RETURN(
          const Summary one, MakeExperiment(name, absl::StrCat(out, "/", name), arguments.options));
      Append(one, name, summary);
    }
  } else {
    PLUMESCOUT_ASSIGN_OR_RETURN(summary, MakeExperiment(arguments.name, out, arguments.options));
  }
  if (arguments.summary.empty()) return absl::OkStatus();
  return WriteSummary(summary, arguments.summary);
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
  experiment->footer(
      "On two cores xit_table3 takes some seven minutes, and team_study one to two hours: 108 "
      "missions of teams of up to eight, and 200 in one-lane buildings (20 with --trials 1). "
      "team_rivals takes some half an hour.");
  experiment
      ->add_option("name", arguments->name,
                   "Which one; all: each but lhr_calibration and those of teams")
      ->required()
      ->check(CLI::IsMember(names));
  experiment->add_option("--out", arguments->out,
                         "Folder for results (default: out/NAME). Studies of many trials keep "
                         "each there, and go on from what they find");
  experiment->add_option("--summary", arguments->summary,
                         "Write the figures to this JSON file too; of all, NAME_ before each");
  experiment
      ->add_option(
          "--trials", options.trials,
          "Trials of each row in each building (default: the paper's; of team_study 1, and "
          "10 where all doors are for one)")
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
