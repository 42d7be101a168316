// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/options.h"
#include "lab/trials/trial.h"

namespace plumescout::lab {

// One way to plan, in a study.
struct StudyRow {
  std::string name;  // of files too: letters, digits, '_'
  MissionOptions mission;
  bool knows_map = false;  // the building's map is the mission's prior map
  // The region that is sampled, of strategies that stop at sites, is the building.
  bool samples_building = false;
  int robots = 1;
  TrialRobot robot = {};
  double most_late_s = 0.0;                     // see Trial
  bool ghosts = false;                          // likewise
  std::optional<TeamRule> rule = {};            // likewise
  std::optional<GasOptions> second_field = {};  // likewise
};

// A strategy of the table, driving until the time is up. With the paper's goals: they are drawn at
// random within a kind, and are random free places once no frontier is left ([XIT] section VI-B),
// and the connection radius of [XIT] Eq. (7) has no limit; else all of them are offered, and then
// places whose gas is unobserved, and the radius has that of the options. All else is ours. Errors:
// as ApplyStrategyRow.
absl::StatusOr<StudyRow> MakeStudyRow(const std::string& name, const std::string& strategy,
                                      bool with_the_papers_goals);

// The row with field and map as missions have them by default, where the mission undoes the lag.
StudyRow AsMissionsAre(StudyRow row);

// A strategy of [XIT] to the letter: goals as above; independent samples, Eq. (8) with the variance
// as it is, paths that end at samples, as they are found or not at all, Algorithm 2 where the robot
// is, and gas as the sensor tells it. Errors: as ApplyStrategyRow.
absl::StatusOr<StudyRow> MakePublishedRow(const std::string& name, const std::string& strategy);

// Every row drives `trials` times through every building.
struct TrialPlan {
  std::vector<StudyRow> rows;
  std::vector<std::string> scenes;  // scene folders
  int trials = 1;                   // with seeds first_seed, first_seed + 1, ...
  std::uint64_t first_seed = 1;
  double duration_s = 300.0;
  std::vector<double> map_times_s = {};
  std::optional<KernelDmvOptions> peer = {};  // see Trial
  bool tells_other_entropies = false;         // likewise
  std::string folder;                         // finished trials are kept here, and taken from here
  int jobs = 1;                               // trials at once
  std::function<void(double)> progress = {};
};

// Of one building: by row and trial, in the order of the plan.
using SceneRecords = std::vector<std::vector<TrialRecord>>;

// By building. Trials with the same number have the same seed in all rows, so they are pairs. The
// result does not depend on the jobs. Errors: as ReadScene, naming the folder; as RunTrial.
absl::StatusOr<std::vector<SceneRecords>> RunTrials(const TrialPlan& plan);

// Last path component of a scene folder.
std::string SceneName(const std::string& folder);

}  // namespace plumescout::lab
