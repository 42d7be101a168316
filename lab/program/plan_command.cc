// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/plan_command.h"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/time/clock.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/program/plan_json.h"
#include "lab/program/planning_step.h"
#include "lab/program/progress_line.h"
#include "lab/program/recording.h"
#include "lab/report/plan_sheet.h"
#include "lab/report/png.h"

namespace plumescout::lab {
namespace {

struct PlanArguments {
  std::string belief;
  std::string out = "out/plan";
  std::int64_t revision = 0;
  PlanningStepOptions step;
};

PlanPicture MakePicture(const PlanningStep& step) {
  PlanPicture picture;
  picture.title = absl::StrFormat("Plan of %s at revision %d, strategy %s", step.plan.robot,
                                  step.plan.belief_revision, step.plan.strategy);
  picture.occupancy = *step.belief->occupancy;
  picture.information = step.information.value;
  for (std::size_t i = 0; i < picture.information.size(); ++i) {
    if ((*step.belief->traversable)[i] == 0) {
      picture.information[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  for (const TreeEdge& edge : step.tree) picture.tree.push_back({edge.parent, edge.child});
  picture.robot = step.belief->robots.at(step.plan.robot).state.pose;
  picture.plan = step.plan;
  // There may be many, and those that are too small tell the least.
  std::stable_partition(
      picture.plan.rejected.begin(), picture.plan.rejected.end(),
      [](const RejectedGoal& r) { return r.reason != RejectionReason::kTooSmall; });
  return picture;
}

absl::Status DrawPlan(const PlanArguments& arguments) {
  ProgressLine progress(absl::Seconds(2));
  PLUMESCOUT_ASSIGN_OR_RETURN(Recording recording, Recording::Open(arguments.belief));
  std::cerr << VersionRemark(recording.code_version());
  constexpr int kSteps = 200;  // of the progress line
  int shown = -1;
  const absl::Time start = absl::Now();
  const auto show = [&](double share) {
    const int step = static_cast<int>(share * kSteps);
    if (step == shown) return;
    shown = step;
    progress.Show(
        absl::StrCat(ProgressWithTimeLeft(share, absl::Now() - start), "  replaying the mission"));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<Mission> mission,
                              Replay(recording, arguments.revision, show));
  std::cerr << EndRemark(recording);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanningStep step, TakePlanningStep(*mission, arguments.step));
  progress.Finish(step.plan.explanation);
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(arguments.out));
  PLUMESCOUT_RETURN_IF_ERROR(WriteFile(absl::StrCat(arguments.out, "/plan.json"),
                                       PlanToJson(step.plan, step.tree.size())));
  const std::string png = absl::StrCat(arguments.out, "/plan.png");
  PLUMESCOUT_RETURN_IF_ERROR(WritePng(DrawPlanSheet(MakePicture(step)), png));
  std::cout << png << "\n";
  return absl::OkStatus();
}

}  // namespace

void AddPlanCommand(CLI::App& app, absl::Status& status) {
  CLI::App* plan = app.add_subcommand("plan", "Draw one planning step of a recorded mission");
  const auto arguments = std::make_shared<PlanArguments>();
  plan->add_option("--belief", arguments->belief, "Recorded mission, of robot --record")
      ->required()
      ->check(CLI::ExistingFile);
  plan->add_option("--out", arguments->out, "Folder for plan.png and plan.json")
      ->capture_default_str();
  plan->add_option("--revision", arguments->revision,
                   "Number of the event after which to plan; 0: the last")
      ->capture_default_str();
  plan->add_option("--robot", arguments->step.robot, "Robot to plan for (default: the first)");
  plan->add_option(
      "--strategy", arguments->step.strategy,
      absl::StrCat("One of ", absl::StrJoin(StrategyNames(), ", "), " (default: the mission's)"));
  plan->add_option("--seed", arguments->step.seed, "Seed of the plan (default: of its number)")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  plan->callback([arguments, &status] { status = DrawPlan(*arguments); });
}

}  // namespace plumescout::lab
