// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/scene_command.h"

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/formats/scene_folder.h"
#include "lab/program/progress_line.h"
#include "lab/report/png.h"
#include "lab/report/scene_sheet.h"
#include "lab/sim/gaden_scene.h"
#include "lab/sim/layout_generator.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/layout_writer.h"
#include "lab/sim/layout_yaml.h"
#include "lab/sim/scene_maker.h"

namespace plumescout::lab {
namespace {

// What is made, and which of how many.
struct Work {
  std::string folder;
  int index = 0;
  int count = 1;
};

absl::Status MakeFolderOf(const Layout& layout, const SceneMakerOptions& options, const Work& work,
                          ProgressLine& progress) {
  const absl::Time start = absl::Now();
  const auto show = [&](absl::string_view stage, double fraction) {
    progress.Show(
        absl::StrCat(ProgressWithTimeLeft(fraction, absl::Now() - start), "  ", stage,
                     work.count > 1 ? absl::StrCat(", ", work.index + 1, " of ", work.count) : ""));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, MakeScene(layout, options, show));
  PLUMESCOUT_RETURN_IF_ERROR(WriteScene(scene, work.folder));
  progress.Finish(absl::StrFormat("%s: %d x %d cells, %d frames, made in %.0f s", work.folder,
                                  scene.geometry().width, scene.geometry().height,
                                  scene.series.frames, absl::ToDoubleSeconds(absl::Now() - start)));
  return absl::OkStatus();
}

struct MakeArguments {
  std::string layout;
  std::string out;
  SceneMakerOptions options;
};

absl::Status Make(const MakeArguments& arguments) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(arguments.options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Layout layout, ReadLayout(arguments.layout));
  const absl::Status fits = Rasterize(layout).status();
  if (!fits.ok()) {
    return absl::Status(fits.code(), absl::StrCat(arguments.layout, ": ", fits.message()));
  }
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(arguments.out));
  ProgressLine progress;
  return MakeFolderOf(layout, arguments.options, {.folder = arguments.out}, progress);
}

struct GenerateArguments {
  std::uint64_t seed = 1;
  int count = 1;
  std::string out = "out/scenes";
  bool layout_only = false;
  SceneMakerOptions options;
};

absl::Status Generate(const GenerateArguments& arguments) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(arguments.options));
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(arguments.out));
  ProgressLine progress;
  for (int i = 0; i < arguments.count; ++i) {
    const std::uint64_t seed = arguments.seed + static_cast<std::uint64_t>(i);
    const Layout layout = GenerateLayout(seed);
    const std::string folder = absl::StrCat(arguments.out, "/", layout.name);
    const std::string yaml = folder + ".yaml";
    PLUMESCOUT_RETURN_IF_ERROR(WriteLayout(layout, yaml));
    std::cout << yaml << "\n";
    if (arguments.layout_only) continue;
    SceneMakerOptions options = arguments.options;
    options.seed = seed;
    PLUMESCOUT_RETURN_IF_ERROR(MakeFolderOf(
        layout, options, {.folder = folder, .index = i, .count = arguments.count}, progress));
  }
  return absl::OkStatus();
}

void AddMakerOptions(CLI::App& command, SceneMakerOptions& options) {
  command.add_option("--frames", options.frames, "Frames of the time series, half a second apart")
      ->capture_default_str();
  command
      .add_option("--warm-up-s", options.warm_up_s,
                  "Seconds of release before the first frame, so that the plume has spread")
      ->capture_default_str();
}

void AddMake(CLI::App& scene, absl::Status& status) {
  CLI::App* make = scene.add_subcommand(
      "make", "Compute wind and gas in a building: from a layout file to a scene folder");
  const auto arguments = std::make_shared<MakeArguments>();
  make->add_option("layout", arguments->layout,
                   "Layout file (YAML); those in lab/scenes show the keys")
      ->required();
  make->add_option("--out", arguments->out, "Scene folder to write")->required();
  make->add_option("--seed", arguments->options.seed, "Seed of the gas's random motion")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  AddMakerOptions(*make, arguments->options);
  make->callback([arguments, &status] { status = Make(*arguments); });
}

void AddGenerate(CLI::App& scene, absl::Status& status) {
  CLI::App* generate =
      scene.add_subcommand("generate", "Draw buildings at random and compute wind and gas in them");
  const auto arguments = std::make_shared<GenerateArguments>();
  generate->add_option("--seed", arguments->seed, "Seed of the first building")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  generate->add_option("--count", arguments->count, "How many buildings; each has the next seed")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  generate
      ->add_option("--out", arguments->out,
                   "Folder for generated_SEED.yaml, the layout, and generated_SEED/, the scene")
      ->capture_default_str();
  generate->add_flag("--layout-only", arguments->layout_only, "Write the layouts, not the scenes");
  AddMakerOptions(*generate, arguments->options);
  generate->callback([arguments, &status] { status = Generate(*arguments); });
}

struct ShowArguments {
  std::string folder;
  std::string out = "out/scene.png";
};

absl::Status Show(const ShowArguments& arguments) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, ReadScene(arguments.folder));
  const std::string parent = std::filesystem::path(arguments.out).parent_path().string();
  if (!parent.empty()) PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(parent));
  PLUMESCOUT_RETURN_IF_ERROR(WritePng(DrawSceneSheet(scene), arguments.out));
  std::cout << arguments.out << "\n";
  return absl::OkStatus();
}

void AddShow(CLI::App& scene, absl::Status& status) {
  CLI::App* show =
      scene.add_subcommand("show", "Draw a scene folder: map, wind and mean gas, as one picture");
  const auto arguments = std::make_shared<ShowArguments>();
  show->add_option("folder", arguments->folder, "Scene folder")
      ->required()
      ->check(CLI::ExistingDirectory);
  show->add_option("--out", arguments->out, "Picture to write (PNG)")->capture_default_str();
  show->callback([arguments, &status] { status = Show(*arguments); });
}

struct ImportArguments {
  GadenImport import;
  std::vector<double> start;  // x, y in metres and, if given, yaw in radians
  std::string out;
};

absl::Status Import(ImportArguments arguments) {
  GadenImport& import = arguments.import;
  import.start_pose = {arguments.start[0], arguments.start[1],
                       arguments.start.size() > 2 ? WrapAngle_rad(arguments.start[2]) : 0.0};
  const std::filesystem::path out(arguments.out);
  import.name = (out.has_filename() ? out : out.parent_path()).filename().string();
  ProgressLine progress;
  const absl::Time start = absl::Now();
  const auto show = [&](absl::string_view stage, double fraction) {
    progress.Show(absl::StrCat(ProgressWithTimeLeft(fraction, absl::Now() - start), "  ", stage));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, ImportGaden(import, show));
  PLUMESCOUT_RETURN_IF_ERROR(WriteScene(scene, arguments.out));
  progress.Finish(absl::StrFormat("%s: %d x %d cells, %d frames, %s", arguments.out,
                                  scene.geometry().width, scene.geometry().height,
                                  scene.series.frames, scene.wind ? "wind" : "no wind"));
  return absl::OkStatus();
}

void AddImport(CLI::App& scene, absl::Status& status) {
  CLI::App* command = scene.add_subcommand(
      "import-gaden", "Convert results of GADEN 2.0 to 2.5 or 3 to a scene folder: one slice");
  const auto arguments = std::make_shared<ImportArguments>();
  GadenImport& import = arguments->import;
  command
      ->add_option("results", import.results,
                   "Folder with the files iteration_N; several, one per source, add up")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", arguments->out, "Scene folder to write")->required();
  command
      ->add_option("--start", arguments->start,
                   "Where the robot starts: x y in metres, and its heading in radians")
      ->expected(2, 3)
      ->type_name("X Y [YAW]")
      ->required();
  command
      ->add_option("--environment", import.environment,
                   "Folder with OccupancyGrid3D.csv (default: RESULTS or up to three above it)")
      ->check(CLI::ExistingDirectory);
  command->add_option("--height-m", import.height_m, "Height of the slice, of the gas sensor")
      ->capture_default_str();
  command
      ->add_option("--frame-period-s", import.frame_period_s,
                   "Seconds between two frames; the files do not tell")
      ->capture_default_str();
  command
      ->add_option("--skip-frames", import.skip_frames,
                   "Frames to leave out at the beginning, while the plume spreads")
      ->capture_default_str();
  command->add_option("--rate-ppm-per-s", import.rates_ppm_per_s,
                      "Release rate of each source, if it is to be noted in the scene");
  command->callback([arguments, &status] { status = Import(*arguments); });
}

}  // namespace

void AddSceneCommand(CLI::App& app, absl::Status& status) {
  CLI::App* scene = app.add_subcommand("scene", "Make, draw and convert gas scenes");
  scene->require_subcommand(1);
  AddMake(*scene, status);
  AddGenerate(*scene, status);
  AddShow(*scene, status);
  AddImport(*scene, status);
}

}  // namespace plumescout::lab
