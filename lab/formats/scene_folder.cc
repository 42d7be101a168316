// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/scene_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/string_view.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "formats/map_server.h"
#include "formats/zstd_codec.h"
#include "lab/formats/npy.h"
#include "lab/formats/scene_json.h"

namespace plumescout::lab {
namespace {

constexpr char kDescriptionFile[] = "scene.json";
constexpr char kMapFile[] = "map.yaml";
constexpr char kMeanFile[] = "conc_mean.npy";
constexpr char kStdFile[] = "conc_std.npy";
constexpr char kMeanBySourceFile[] = "conc_mean_by_source.npy";
constexpr char kSeriesFile[] = "conc_ts.u16.zst";
constexpr char kWindFile[] = "wind_uv.npy";

constexpr std::uint64_t kMaxDescriptionBytes = 1 << 20;
constexpr std::uint64_t kMaxSeriesBytes = std::uint64_t{1} << 31;  // unpacked
constexpr std::size_t kWindComponents = 2;
constexpr float kAnyFinite = std::numeric_limits<float>::lowest();
// Of a cell, by which map.yaml and scene.json may differ: both print decimals.
constexpr double kGeometryTolerance_cells = 1e-3;

std::string FileIn(const std::string& folder, absl::string_view name) {
  return (std::filesystem::path(folder) / std::string(name)).string();
}

std::vector<std::size_t> RasterShape(const GridGeometry& geometry) {
  return {static_cast<std::size_t>(geometry.height), static_cast<std::size_t>(geometry.width)};
}

// "[4, 5]".
std::string ShapeText(const std::vector<std::size_t>& shape) {
  return absl::StrCat("[", absl::StrJoin(shape, ", "), "]");
}

std::vector<std::size_t> PlaceOf(std::size_t index, const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> place(shape.size());
  for (std::size_t i = shape.size(); i > 0; --i) {
    place[i - 1] = index % shape[i - 1];
    index /= shape[i - 1];
  }
  return place;
}

// Values of this shape that are finite and at least `lowest`.
absl::StatusOr<std::vector<float>> ReadValues(const std::string& path,
                                              const std::vector<std::size_t>& shape, float lowest) {
  PLUMESCOUT_ASSIGN_OR_RETURN(NpyArray array, ReadNpy(path));
  if (array.shape != shape) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": the shape is ", ShapeText(array.shape),
                                                   ", by scene.json it must be ",
                                                   ShapeText(shape)));
  }
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    if (std::isfinite(array.values[i]) && array.values[i] >= lowest) continue;
    return absl::InvalidArgumentError(
        absl::StrCat(path, ": the value at ", ShapeText(PlaceOf(i, shape)), " is ", array.values[i],
                     ", it must be finite", lowest == 0.0F ? " and >= 0" : ""));
  }
  return std::move(array.values);
}

Grid<float> MakeGrid(const GridGeometry& geometry, std::span<const float> values) {
  Grid<float> grid(geometry);
  std::copy(values.begin(), values.end(), grid.values().begin());
  return grid;
}

absl::StatusOr<Grid<float>> ReadRaster(const std::string& path, const GridGeometry& geometry) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<float> values,
                              ReadValues(path, RasterShape(geometry), 0.0F));
  return MakeGrid(geometry, values);
}

absl::StatusOr<std::vector<Grid<float>>> ReadLayers(const std::string& path,
                                                    const GridGeometry& geometry,
                                                    std::size_t count) {
  std::vector<std::size_t> shape = RasterShape(geometry);
  shape.insert(shape.begin(), count);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<float> values, ReadValues(path, shape, 0.0F));
  std::vector<Grid<float>> layers;
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const float> all(values);
    layers.push_back(MakeGrid(geometry, all.subspan(i * geometry.size(), geometry.size())));
  }
  return layers;
}

std::string GeometryText(const GridGeometry& geometry) {
  return absl::StrCat(geometry.width, " x ", geometry.height, " cells of ", geometry.resolution_m,
                      " m from (", geometry.origin_x_m, ", ", geometry.origin_y_m, ")");
}

// The geometry of scene.json is kept; map.yaml must agree.
absl::StatusOr<Grid<CellState>> ReadOccupancy(const std::string& path,
                                              const GridGeometry& geometry) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Grid<CellState> map, ReadMapServer(path));
  const double tolerance_m = kGeometryTolerance_cells * geometry.resolution_m;
  const GridGeometry& found = map.geometry();
  const bool same = found.width == geometry.width && found.height == geometry.height &&
                    std::abs(found.origin_x_m - geometry.origin_x_m) <= tolerance_m &&
                    std::abs(found.origin_y_m - geometry.origin_y_m) <= tolerance_m &&
                    std::abs(found.resolution_m - geometry.resolution_m) <= tolerance_m;
  if (!same) {
    return absl::InvalidArgumentError(absl::StrCat(path, " shows ", GeometryText(found),
                                                   ", by scene.json it must be ",
                                                   GeometryText(geometry)));
  }
  Grid<CellState> occupancy(geometry);
  occupancy.values() = std::move(map.values());
  return occupancy;
}

absl::StatusOr<std::vector<std::uint16_t>> ReadCounts(const std::string& path, int frames,
                                                      const GridGeometry& geometry) {
  const std::uint64_t count = static_cast<std::uint64_t>(frames) * geometry.size();
  if (count > kMaxSeriesBytes / sizeof(std::uint16_t)) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": more than 2^31 bytes unpacked"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string frame, ReadFile(path, kMaxSeriesBytes));
  std::vector<std::uint16_t> counts(count);
  const absl::Status status =
      DecompressZstd(frame, reinterpret_cast<char*>(counts.data()), count * sizeof(std::uint16_t));
  if (status.ok()) return counts;
  return absl::Status(status.code(), absl::StrCat(path, ": ", status.message()));
}

absl::StatusOr<WindField> ReadWind(const std::string& path, const GridGeometry& geometry) {
  std::vector<std::size_t> shape = RasterShape(geometry);
  shape.push_back(kWindComponents);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<float> values, ReadValues(path, shape, kAnyFinite));
  WindField wind{Grid<float>(geometry), Grid<float>(geometry)};
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    wind.u_mps[i] = values[kWindComponents * i];
    wind.v_mps[i] = values[kWindComponents * i + 1];
  }
  return wind;
}

absl::Status WriteWind(const WindField& wind, const std::string& path) {
  std::vector<float> values;
  values.reserve(kWindComponents * wind.u_mps.size());
  for (std::size_t i = 0; i < wind.u_mps.size(); ++i) {
    values.push_back(wind.u_mps[i]);
    values.push_back(wind.v_mps[i]);
  }
  std::vector<std::size_t> shape = RasterShape(wind.u_mps.geometry());
  shape.push_back(kWindComponents);
  return WriteNpy(path, shape, values);
}

absl::Status WriteLayers(const Scene& scene, const std::string& path) {
  std::vector<float> values;
  for (const Grid<float>& layer : scene.conc_mean_by_source_ppm) {
    values.insert(values.end(), layer.values().begin(), layer.values().end());
  }
  std::vector<std::size_t> shape = RasterShape(scene.geometry());
  shape.insert(shape.begin(), scene.conc_mean_by_source_ppm.size());
  return WriteNpy(path, shape, values);
}

absl::Status WriteSeries(const ConcentrationSeries& series, const std::string& path) {
  const absl::string_view bytes(reinterpret_cast<const char*>(series.counts.data()),
                                series.counts.size() * sizeof(std::uint16_t));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string frame, CompressZstd(bytes));
  return WriteFile(path, frame);
}

}  // namespace

absl::StatusOr<Scene> ReadScene(const std::string& folder) {
  const std::string description_path = FileIn(folder, kDescriptionFile);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string text,
                              ReadFile(description_path, kMaxDescriptionBytes));
  absl::StatusOr<SceneDescription> description = ParseSceneJson(text);
  if (!description.ok()) {
    const absl::Status& status = description.status();
    return absl::Status(status.code(), absl::StrCat(description_path, ": ", status.message()));
  }
  const SceneFiles& files = description->files;
  Scene scene = std::move(description->scene);
  const GridGeometry geometry = scene.geometry();
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.occupancy, ReadOccupancy(FileIn(folder, kMapFile), geometry));
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.conc_mean_ppm, ReadRaster(FileIn(folder, kMeanFile), geometry));
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.conc_std_ppm, ReadRaster(FileIn(folder, kStdFile), geometry));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      scene.conc_mean_by_source_ppm,
      ReadLayers(FileIn(folder, kMeanBySourceFile), geometry, scene.sources.size()));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      scene.series.counts, ReadCounts(FileIn(folder, files.series), scene.series.frames, geometry));
  if (files.wind) {
    PLUMESCOUT_ASSIGN_OR_RETURN(scene.wind, ReadWind(FileIn(folder, *files.wind), geometry));
  }
  const absl::Status status = ValidateScene(scene);
  if (status.ok()) return scene;
  return absl::Status(status.code(), absl::StrCat(folder, ": ", status.message()));
}

absl::Status WriteScene(const Scene& scene, const std::string& folder) {
  PLUMESCOUT_RETURN_IF_ERROR(ValidateScene(scene));
  const std::vector<std::size_t> shape = RasterShape(scene.geometry());
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(folder));
  PLUMESCOUT_RETURN_IF_ERROR(WriteMapServer(scene.occupancy, FileIn(folder, kMapFile)));
  PLUMESCOUT_RETURN_IF_ERROR(
      WriteNpy(FileIn(folder, kMeanFile), shape, scene.conc_mean_ppm.values()));
  PLUMESCOUT_RETURN_IF_ERROR(
      WriteNpy(FileIn(folder, kStdFile), shape, scene.conc_std_ppm.values()));
  PLUMESCOUT_RETURN_IF_ERROR(WriteLayers(scene, FileIn(folder, kMeanBySourceFile)));
  PLUMESCOUT_RETURN_IF_ERROR(WriteSeries(scene.series, FileIn(folder, kSeriesFile)));
  if (scene.wind) PLUMESCOUT_RETURN_IF_ERROR(WriteWind(*scene.wind, FileIn(folder, kWindFile)));
  SceneFiles files{.series = kSeriesFile, .wind = std::nullopt};
  if (scene.wind) files.wind = kWindFile;
  return WriteFile(FileIn(folder, kDescriptionFile), FormatSceneJson(scene, files));
}

}  // namespace plumescout::lab
