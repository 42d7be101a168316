// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/study_scenes.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/formats/scene_folder.h"
#include "lab/sim/layout_generator.h"
#include "lab/sim/scene_maker.h"
#include "lab/trials/task_pool.h"
#include "lab/worlds/bundled_layouts.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kHallSeed = 1;  // of the filaments, whatever the study's

SceneMakerOptions SceneOptions(bool quick, double duration_s, std::uint64_t seed) {
  SceneMakerOptions options;
  options.seed = seed;
  options.frames = static_cast<int>(std::lround(duration_s / options.frame_period_s));
  if (quick) {
    options.wind.flow_s = 5.0;
    options.warm_up_s = 60.0;
  }
  return options;
}

// Written beside its place and then moved there, so that a folder that stands is whole.
absl::Status MakeUnlessThere(const Layout& layout, const SceneMakerOptions& options,
                             const std::string& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error)) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, MakeScene(layout, options));
  const std::string part = folder + ".part";
  PLUMESCOUT_RETURN_IF_ERROR(WriteScene(scene, part));
  std::filesystem::rename(part, folder, error);
  if (!error) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat("cannot make ", folder, ": ", error.message()));
}

absl::StatusOr<std::string> SceneRoot(const ExperimentOptions& options) {
  if (options.folder.empty()) {
    return absl::InvalidArgumentError("the study needs a folder for its scenes");
  }
  const std::string root = absl::StrCat(options.folder, "/scenes");
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(root));
  return root;
}

std::string SceneFolder(const std::string& root, const std::string& name, bool quick) {
  return absl::StrCat(root, "/", name, quick ? "_quick" : "");
}

}  // namespace

absl::StatusOr<std::vector<std::string>> HallScene(const ExperimentOptions& options,
                                                   double duration_s) {
  if (!options.scenes.empty()) return options.scenes;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string root, SceneRoot(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Layout layout, BundledLayout("industrial_16x20"));
  const std::string folder = SceneFolder(root, layout.name, options.quick);
  PLUMESCOUT_RETURN_IF_ERROR(
      MakeUnlessThere(layout, SceneOptions(options.quick, duration_s, kHallSeed), folder));
  return std::vector<std::string>{folder};
}

absl::StatusOr<std::vector<std::string>> GeneratedScenes(const ExperimentOptions& options,
                                                         const GeneratedBuildings& buildings,
                                                         double duration_s) {
  const auto layout_of = [&buildings](std::uint64_t seed) {
    return GenerateLayout(seed, buildings.generator);
  };
  return LayoutScenes(options, buildings, layout_of, duration_s);
}

absl::StatusOr<std::vector<std::string>> LayoutScenes(
    const ExperimentOptions& options, const GeneratedBuildings& buildings,
    const std::function<Layout(std::uint64_t seed)>& layout_of, double duration_s) {
  if (!options.scenes.empty()) return options.scenes;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string root, SceneRoot(options));
  std::vector<std::string> folders;
  for (int i = 0; i < buildings.count; ++i) {
    const std::string name =
        absl::StrCat(buildings.name, "_", buildings.first_seed + static_cast<std::uint64_t>(i));
    folders.push_back(SceneFolder(root, name, options.quick));
  }
  PLUMESCOUT_RETURN_IF_ERROR(RunTasks(
      folders.size(), options.jobs,
      [&](std::size_t i) {
        const std::uint64_t seed = buildings.first_seed + i;
        return MakeUnlessThere(layout_of(seed), SceneOptions(options.quick, duration_s, seed),
                               folders[i]);
      },
      options.progress));
  return folders;
}

}  // namespace plumescout::lab
