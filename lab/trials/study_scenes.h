// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "lab/sim/layout.h"
#include "lab/sim/layout_generator.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Scene folders that a study drives through: options.scenes if there are any; else its own, made in
// options.folder/scenes unless they stand there. Quick ones have a short wind and warm-up.
// Errors: kInvalidArgument without a folder; as MakeScene and WriteScene.

// The industrial hall of [XIT] Fig. 6, ours, with gas for `duration_s`.
absl::StatusOr<std::vector<std::string>> HallScene(const ExperimentOptions& options,
                                                   double duration_s);

// Buildings of GenerateLayout with seeds first_seed, first_seed + 1, ...
struct GeneratedBuildings {
  std::uint64_t first_seed = 1;
  int count = 1;
  const char* name = "building";  // of their folders, before the seed
  GeneratorOptions generator = {};
};

// The same of layouts that `layout_of` makes from those seeds; the generator's options are not
// looked at.
absl::StatusOr<std::vector<std::string>> LayoutScenes(
    const ExperimentOptions& options, const GeneratedBuildings& buildings,
    const std::function<Layout(std::uint64_t seed)>& layout_of, double duration_s);

// Made options.jobs at once. Progress goes from 0 to 1.
absl::StatusOr<std::vector<std::string>> GeneratedScenes(const ExperimentOptions& options,
                                                         const GeneratedBuildings& buildings,
                                                         double duration_s);

}  // namespace plumescout::lab
