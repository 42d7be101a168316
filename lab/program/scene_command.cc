// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/scene_command.h"

#include <cstdint>
#include <memory>
#include <string>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "formats/scene_folder.h"
#include "lab/program/progress_line.h"
#include "lab/sim/layout_yaml.h"
#include "lab/sim/scene_maker.h"

namespace plumescout::lab {
namespace {

struct SceneMakeArguments {
  std::string layout;
  std::string out;
  SceneMakerOptions options;
};

absl::Status MakeSceneFolder(const SceneMakeArguments& arguments) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Layout layout, ReadLayout(arguments.layout));
  ProgressLine progress;
  const absl::Time start = absl::Now();
  const auto show = [&](absl::string_view stage, double fraction) {
    progress.Show(absl::StrFormat("%s %3.0f %%  %s", ProgressBar(fraction), 100.0 * fraction,
                                  std::string(stage)));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, MakeScene(layout, arguments.options, show));
  PLUMESCOUT_RETURN_IF_ERROR(WriteScene(scene, arguments.out));
  progress.Finish(absl::StrFormat("%s: %d x %d cells, %d frames, made in %.0f s", arguments.out,
                                  scene.geometry().width, scene.geometry().height,
                                  scene.series.frames, absl::ToDoubleSeconds(absl::Now() - start)));
  return absl::OkStatus();
}

}  // namespace

void AddSceneCommand(CLI::App& app, absl::Status& status) {
  CLI::App* scene = app.add_subcommand("scene", "Make gas scenes");
  scene->require_subcommand(1);
  CLI::App* make = scene->add_subcommand(
      "make", "Wind and gas in a building: from a layout file (YAML) to a scene folder");
  const auto arguments = std::make_shared<SceneMakeArguments>();
  SceneMakerOptions& options = arguments->options;
  make->add_option("layout", arguments->layout, "Layout file")->required();
  make->add_option("--out", arguments->out, "Scene folder to write")->required();
  make->add_option("--seed", options.seed, "Seed of the filaments")->capture_default_str();
  make->add_option("--frames", options.frames, "Frames of the time series")->capture_default_str();
  make->add_option("--warm-up-s", options.warm_up_s, "Release before the first frame, seconds")
      ->capture_default_str();
  make->callback([arguments, &status] { status = MakeSceneFolder(*arguments); });
}

}  // namespace plumescout::lab
