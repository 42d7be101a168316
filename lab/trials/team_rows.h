// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "lab/report/palette.h"
#include "lab/rivals/team_rival.h"
#include "lab/trials/study.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {

// One kind of team, in studies of teams.
struct TeamRow {
  int robots = 1;
  bool yields = true;       // plans wait for the ways of others
  bool anticipates = true;  // and leave out what those will tell
  const char* name = "";
  const char* label = "";
  Rgb color = {};
  double most_late_s = 0.0;                     // legs fall behind by up to this
  bool ghosts = false;                          // robots pass through each other
  std::optional<TeamRule> rule = std::nullopt;  // of others; none: strategy "plumescout"
  bool balanced_areas = false;                  // each robot has its own
  double replan_period_s = 1.5;                 // of ours, on their way; 0: when they are there
};

// Robots that share a mission with that strategy or rule. Errors: as MakeStudyRow.
absl::StatusOr<StudyRow> MakeStudyRow(const TeamRow& team);

// Buildings of one size. Those with seeds 500 to 505 and from 600 on were tuned on.
struct BuildingSize {
  const char* name = "";
  const char* label = "";
  GeneratedBuildings buildings = {};
  bool is_tight = false;  // all doors and lanes are for one: do robots get stuck?
};
inline constexpr GeneratorOptions kSmallBuilding = {
    .min_size_m = 16, .max_size_x_m = 21, .max_size_y_m = 23};
inline constexpr GeneratorOptions kLargeBuilding = {
    .min_size_m = 34, .max_size_x_m = 40, .max_size_y_m = 40};
inline constexpr BuildingSize kGivenBuildings = {"given", "scenes given"};

// All trials in buildings of one size.
struct SizeResult {
  const BuildingSize* size = nullptr;
  std::vector<TeamRow> teams;
  TrialPlan plan;
  std::vector<SceneRecords> records;  // rows as teams
};

// Drives all teams through all buildings: one if quick; options.trials times, else `trials`.
// Errors: as GeneratedScenes and RunTrials.
absl::StatusOr<SizeResult> RunSize(const ExperimentOptions& options, const BuildingSize& size,
                                   std::vector<TeamRow> teams, double duration_s, int trials);

// Of the sizes in turn, with options.progress for them together; `told` gets each result as it is
// done, and may fail.
struct SizeToRun {
  const BuildingSize* size = nullptr;
  std::vector<TeamRow> teams;
  double duration_s = 0.0;
  int trials = 1;
};
absl::Status RunSizes(const ExperimentOptions& options, const std::vector<SizeToRun>& sizes,
                      const std::function<absl::Status(const SizeResult&)>& told);

}  // namespace plumescout::lab
