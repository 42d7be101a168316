// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gaden_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/strip.h"
#include "core/grid/flood.h"
#include "core/grid/mask.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "lab/formats/gaden_environment.h"
#include "lab/formats/gaden_frame.h"
#include "lab/formats/gaden_wind.h"
#include "lab/sim/frame_recorder.h"
#include "lab/sim/gaden_slice.h"

namespace plumescout::lab {
namespace {

namespace fs = std::filesystem;

constexpr char kEnvironmentFile[] = "OccupancyGrid3D.csv";
constexpr char kFramePrefix[] = "iteration_";
constexpr double kMaxFramePeriod_s = 60.0;

absl::Status Invalid(const std::string& what) { return absl::InvalidArgumentError(what); }

absl::Status CheckFields(const GadenImport& import) {
  if (import.results.empty()) return Invalid("results must name a folder");
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRangeAbove("frame_period_s", import.frame_period_s, 0.0, kMaxFramePeriod_s)
          .AtLeast("skip_frames", import.skip_frames, 0)
          .status());
  if (import.rates_ppm_per_s.empty() || import.rates_ppm_per_s.size() == import.results.size()) {
    return absl::OkStatus();
  }
  return Invalid(absl::StrCat(import.rates_ppm_per_s.size(), " rates for ", import.results.size(),
                              " result folders"));
}

absl::StatusOr<fs::path> FindEnvironment(const GadenImport& import) {
  if (!import.environment.empty()) return fs::path(import.environment);
  constexpr int kLevels = 4;  // configuration/simulations/NAME/result
  std::error_code ignored;
  fs::path folder = fs::absolute(import.results.front()).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  for (int i = 0; i < kLevels; ++i, folder = folder.parent_path()) {
    if (fs::exists(folder / kEnvironmentFile, ignored)) return folder;
  }
  return absl::NotFoundError(absl::StrCat("no ", kEnvironmentFile, " in ", import.results.front(),
                                          " or the three folders above it; name its folder"));
}

// The files of consecutive frames, without those to skip.
absl::StatusOr<std::vector<std::string>> FrameFiles(const std::string& folder, int skip) {
  std::set<int> numbers;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    absl::string_view digits = name;
    int number = 0;
    if (absl::ConsumePrefix(&digits, kFramePrefix) && absl::SimpleAtoi(digits, &number)) {
      numbers.insert(number);
    }
  }
  if (error) return absl::NotFoundError(absl::StrCat(folder, ": ", error.message()));
  std::vector<std::string> files;
  for (const int number : numbers) {
    const int expected = *numbers.begin() + static_cast<int>(files.size());
    if (number != expected) {
      return Invalid(absl::StrCat(folder, "/", kFramePrefix, expected, " is missing"));
    }
    files.push_back(absl::StrCat(folder, "/", kFramePrefix, number));
  }
  if (files.size() <= static_cast<std::size_t>(skip)) {
    return absl::NotFoundError(absl::StrCat(folder, ": ", files.size(), " files ", kFramePrefix,
                                            "N, ", skip, " of them to skip"));
  }
  files.erase(files.begin(), files.begin() + skip);
  return files;
}

// [result][frame].
using FrameLists = std::vector<std::vector<std::string>>;

absl::StatusOr<FrameLists> AllFrameFiles(const GadenImport& import) {
  FrameLists lists;
  for (const std::string& folder : import.results) {
    PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<std::string> files,
                                FrameFiles(folder, import.skip_frames));
    if (!lists.empty() && lists.front().size() != files.size()) {
      return Invalid(absl::StrCat(folder, " has ", files.size(), " frames, ",
                                  import.results.front(), " ", lists.front().size()));
    }
    lists.push_back(std::move(files));
  }
  return lists;
}

absl::StatusOr<GadenFrame> ReadFrameOf(const std::string& path,
                                       const GadenEnvironment& environment) {
  PLUMESCOUT_ASSIGN_OR_RETURN(GadenFrame frame, ReadGadenFrame(path));
  if (frame.cells == environment.cells) return frame;
  return Invalid(absl::StrCat(path, " is of ", absl::StrJoin(frame.cells, " x "), " cells, ",
                              kEnvironmentFile, " of ", absl::StrJoin(environment.cells, " x ")));
}

absl::StatusOr<Grid<CellState>> MapSlice(const GadenEnvironment& environment,
                                         const GadenImport& import) {
  const double top_m = environment.min[2] + environment.cells[2] * environment.cell_size_m;
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRangeBelow("height_m", import.height_m, std::max(0.0, environment.min[2]), top_m)
          .status());
  const int z = LayerAt(environment, import.height_m);
  Grid<std::uint8_t> open(SliceGeometry(environment));
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Cell cell = open.geometry().CellAtIndex(i);
    const GadenCell state = environment.states[environment.Index(cell.x, cell.y, z)];
    open[i] = state == GadenCell::kFree ? 1 : 0;
  }
  const Pose2& start = import.start_pose;
  const Cell cell = open.geometry().CellAt(start.position());
  if (!std::isfinite(start.x_m) || !std::isfinite(start.y_m) || open.At(cell, 0) == 0) {
    return Invalid(absl::StrCat("the start (", start.x_m, ", ", start.y_m,
                                ") is not in a free cell at height ", import.height_m, " m"));
  }
  const Grid<std::uint8_t> reachable = ReachableCells(open, {cell}, Connectivity::kFour);
  Grid<CellState> map(open.geometry(), CellState::kOccupied);
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (reachable[i] != 0) map[i] = CellState::kFree;
  }
  return map;
}

void ClearOccupied(const Grid<CellState>& map, Grid<float>& values) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] != CellState::kFree) values[i] = 0.0F;
  }
}

std::optional<fs::path> WindFolder(const GadenImport& import, const fs::path& environment) {
  std::error_code ignored;
  for (const fs::path& folder : {fs::path(import.results.front()), environment}) {
    if (fs::is_directory(folder / "wind", ignored)) return folder / "wind";
  }
  return std::nullopt;
}

// `frames_by_wind`: how many frames each wind file was blown by.
absl::StatusOr<WindField> MeanWind(const fs::path& folder, const GadenEnvironment& environment,
                                   int layer, const std::map<int, int>& frames_by_wind) {
  const GridGeometry geometry = SliceGeometry(environment);
  WindField mean{Grid<float>(geometry), Grid<float>(geometry)};
  int frames = 0;
  for (const auto& [index, count] : frames_by_wind) frames += count;
  for (const auto& [index, count] : frames_by_wind) {
    const fs::path path = folder / absl::StrCat("wind_iteration_", index);
    PLUMESCOUT_ASSIGN_OR_RETURN(const WindField wind,
                                ReadGadenWind(path.string(), environment, layer));
    const float share = static_cast<float>(count) / static_cast<float>(frames);
    for (std::size_t i = 0; i < geometry.size(); ++i) {
      mean.u_mps[i] += share * wind.u_mps[i];
      mean.v_mps[i] += share * wind.v_mps[i];
    }
  }
  return mean;
}

// Slices all frames into the scene; how many frames each wind file was blown by.
absl::StatusOr<std::map<int, int>> SliceFrames(const GadenImport& import, const FrameLists& files,
                                               const GadenEnvironment& environment,
                                               const ProgressFn& progress, Scene& scene) {
  const std::size_t frames = files.front().size();
  FrameRecorder recorder(scene.geometry(), files.size(), static_cast<int>(frames),
                         import.frame_period_s);
  std::map<int, int> frames_by_wind;
  for (std::size_t i = 0; i < frames; ++i) {
    std::vector<Grid<float>> layers;
    for (std::size_t s = 0; s < files.size(); ++s) {
      PLUMESCOUT_ASSIGN_OR_RETURN(const GadenFrame frame, ReadFrameOf(files[s][i], environment));
      layers.push_back(SliceGadenFrame(environment, frame, import.height_m));
      ClearOccupied(scene.occupancy, layers.back());
      if (s == 0) ++frames_by_wind[frame.wind_index];
    }
    recorder.Add(layers);
    if (progress) progress("frames", static_cast<double>(i + 1) / static_cast<double>(frames));
  }
  recorder.MoveTo(scene);
  return frames_by_wind;
}

absl::Status AddSources(const GadenImport& import, const FrameLists& files,
                        const GadenEnvironment& environment, Scene& scene) {
  for (std::size_t s = 0; s < files.size(); ++s) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const GadenFrame frame, ReadFrameOf(files[s].front(), environment));
    GasSource source;
    source.id = static_cast<int>(s);
    source.x_m = frame.source_m[0];
    source.y_m = frame.source_m[1];
    source.z_m = frame.source_m[2];
    if (!import.rates_ppm_per_s.empty()) source.rate_ppm_per_s = import.rates_ppm_per_s[s];
    scene.sources.push_back(source);
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Scene> ImportGaden(const GadenImport& import, const ProgressFn& progress) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckFields(import));
  PLUMESCOUT_ASSIGN_OR_RETURN(const fs::path folder, FindEnvironment(import));
  PLUMESCOUT_ASSIGN_OR_RETURN(const FrameLists files, AllFrameFiles(import));
  PLUMESCOUT_ASSIGN_OR_RETURN(const GadenEnvironment environment,
                              ReadGadenEnvironment((folder / kEnvironmentFile).string()));
  Scene scene;
  scene.name = import.name;
  scene.sensor_height_m = import.height_m;
  scene.start_pose = import.start_pose;
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.occupancy, MapSlice(environment, import));
  PLUMESCOUT_RETURN_IF_ERROR(AddSources(import, files, environment, scene));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto frames_by_wind,
                              SliceFrames(import, files, environment, progress, scene));
  if (const std::optional<fs::path> wind = WindFolder(import, folder)) {
    const int layer = LayerAt(environment, import.height_m);
    PLUMESCOUT_ASSIGN_OR_RETURN(scene.wind, MeanWind(*wind, environment, layer, frames_by_wind));
    ClearOccupied(scene.occupancy, scene.wind->u_mps);
    ClearOccupied(scene.occupancy, scene.wind->v_mps);
  }
  PLUMESCOUT_RETURN_IF_ERROR(ValidateScene(scene));
  return scene;
}

}  // namespace plumescout::lab
