// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/map_server.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdint>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "formats/pgm.h"

namespace plumescout {
namespace {

constexpr std::uint64_t kMaxYamlBytes = 65536;
constexpr double kMaxResolution_m = 100.0;
constexpr double kMaxOrigin_m = 1e6;
constexpr int kMaxGray = 255;
// As map_saver writes them; with the thresholds below grey 205 (p = 0.19608) reads as unknown.
constexpr std::uint8_t kFreeGray = 254;
constexpr std::uint8_t kOccupiedGray = 0;
constexpr std::uint8_t kUnknownGray = 205;
constexpr double kWrittenOccupiedThreshold = 0.65;
constexpr double kWrittenFreeThreshold = 0.196;

// The YAML half of a map.
struct MapHeader {
  std::string image;
  std::string mode = "trinary";
  bool negate = false;
  double resolution_m = 0.0;
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double yaw_rad = 0.0;
  double occupied_threshold = 0.0;  // probability
  double free_threshold = 0.0;      // probability
};

absl::StatusOr<MapHeader> ParseYaml(const std::string& text) {
  MapHeader header;
  try {  // yaml-cpp reports by exceptions: they end here
    const YAML::Node root = YAML::Load(text);
    if (root["image"]) header.image = root["image"].as<std::string>();
    if (root["mode"]) header.mode = root["mode"].as<std::string>();
    header.negate = root["negate"].as<int>() != 0;
    header.resolution_m = root["resolution"].as<double>();
    const YAML::Node origin = root["origin"];
    header.origin_x_m = origin[0].as<double>();
    header.origin_y_m = origin[1].as<double>();
    header.yaw_rad = origin[2].as<double>();
    header.occupied_threshold = root["occupied_thresh"].as<double>();
    header.free_threshold = root["free_thresh"].as<double>();
  } catch (const YAML::Exception& error) {
    return absl::DataLossError(error.what());
  }
  return header;
}

// Conditions are written so that NaN fails them.
absl::Status ValidateHeader(const MapHeader& header) {
  if (header.mode != "trinary") {
    return absl::InvalidArgumentError(absl::StrCat("mode \"", header.mode, "\" is not trinary"));
  }
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker().InRangeAbove("resolution", header.resolution_m, 0.0, kMaxResolution_m).status());
  if (!(std::abs(header.origin_x_m) <= kMaxOrigin_m &&
        std::abs(header.origin_y_m) <= kMaxOrigin_m)) {
    return absl::InvalidArgumentError("origin must be within 1e6 m");
  }
  if (header.yaw_rad != 0.0) {
    return absl::InvalidArgumentError(
        absl::StrCat("origin yaw = ", header.yaw_rad, ": turned maps are not read"));
  }
  if (!(header.free_threshold >= 0.0 && header.free_threshold <= header.occupied_threshold &&
        header.occupied_threshold <= 1.0)) {
    return absl::InvalidArgumentError(
        absl::StrCat("thresholds must satisfy 0 <= free_thresh = ", header.free_threshold,
                     " <= occupied_thresh = ", header.occupied_threshold, " <= 1"));
  }
  return absl::OkStatus();
}

absl::StatusOr<MapHeader> ParseHeader(const std::string& text) {
  PLUMESCOUT_ASSIGN_OR_RETURN(MapHeader header, ParseYaml(text));
  PLUMESCOUT_RETURN_IF_ERROR(ValidateHeader(header));
  return header;
}

absl::Status Prefixed(absl::string_view prefix, const absl::Status& status) {
  return absl::Status(status.code(), absl::StrCat(prefix, status.message()));
}

absl::StatusOr<MapHeader> ReadHeader(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMaxYamlBytes));
  absl::StatusOr<MapHeader> header = ParseHeader(text);
  if (header.ok() && header->image.empty()) header = absl::DataLossError("names no image");
  if (!header.ok()) return Prefixed(absl::StrCat(path, ": "), header.status());
  return header;
}

CellState Classify(std::uint8_t gray, const MapHeader& header) {
  const double p = (header.negate ? gray : kMaxGray - gray) / static_cast<double>(kMaxGray);
  if (p > header.occupied_threshold) return CellState::kOccupied;
  if (p < header.free_threshold) return CellState::kFree;
  return CellState::kUnknown;
}

std::uint8_t GrayOf(CellState state) {
  switch (state) {
    case CellState::kFree:
      return kFreeGray;
    case CellState::kOccupied:
      return kOccupiedGray;
    case CellState::kUnknown:
      break;
  }
  return kUnknownGray;
}

// Index of the pixel that shows `cell`: row 0 of the image is the northern one.
std::size_t PixelIndex(const GridGeometry& geometry, Cell cell) {
  return geometry.Index({cell.x, geometry.height - 1 - cell.y});
}

absl::Status ValidateGeometry(const GridGeometry& geometry) {
  const bool ok = geometry.size() > 0 && geometry.resolution_m > 0.0 &&
                  geometry.resolution_m <= kMaxResolution_m &&
                  std::abs(geometry.origin_x_m) <= kMaxOrigin_m &&
                  std::abs(geometry.origin_y_m) <= kMaxOrigin_m;
  if (ok) return absl::OkStatus();
  return absl::InvalidArgumentError("the map is empty or its geometry out of range");
}

Grid<CellState> MakeMap(const MapHeader& header, const GrayImage& image) {
  Grid<CellState> map({.origin_x_m = header.origin_x_m,
                       .origin_y_m = header.origin_y_m,
                       .resolution_m = header.resolution_m,
                       .width = image.width,
                       .height = image.height});
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Cell cell = map.geometry().CellAtIndex(i);
    map[i] = Classify(image.pixels[PixelIndex(map.geometry(), cell)], header);
  }
  return map;
}

}  // namespace

absl::StatusOr<Grid<CellState>> ReadMapServer(const std::string& yaml_path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MapHeader header, ReadHeader(yaml_path));
  const std::filesystem::path folder = std::filesystem::path(yaml_path).parent_path();
  PLUMESCOUT_ASSIGN_OR_RETURN(const GrayImage image, ReadPgm((folder / header.image).string()));
  return MakeMap(header, image);
}

absl::StatusOr<Grid<CellState>> ParseMapServer(absl::string_view yaml, absl::string_view pgm) {
  if (yaml.size() > kMaxYamlBytes) {
    return absl::InvalidArgumentError(
        absl::StrCat("yaml of ", yaml.size(), " bytes: at most ", kMaxYamlBytes, " are read"));
  }
  const absl::StatusOr<MapHeader> header = ParseHeader(std::string(yaml));
  if (!header.ok()) return Prefixed("yaml ", header.status());
  const absl::StatusOr<GrayImage> image = ParsePgm(pgm);
  if (!image.ok()) return Prefixed("pgm ", image.status());
  return MakeMap(*header, *image);
}

absl::Status WriteMapServer(const Grid<CellState>& map, const std::string& yaml_path) {
  const GridGeometry& geometry = map.geometry();
  if (const absl::Status status = ValidateGeometry(geometry); !status.ok()) {
    return absl::Status(status.code(), absl::StrCat(yaml_path, ": ", status.message()));
  }
  GrayImage image{map.width(), map.height(), std::vector<std::uint8_t>(map.size())};
  for (std::size_t i = 0; i < map.size(); ++i) {
    image.pixels[PixelIndex(geometry, geometry.CellAtIndex(i))] = GrayOf(map[i]);
  }
  const std::filesystem::path image_path =
      std::filesystem::path(yaml_path).replace_extension(".pgm");
  PLUMESCOUT_RETURN_IF_ERROR(WritePgm(image, image_path.string()));
  const std::string yaml = absl::StrFormat(
      "image: %s\nmode: trinary\nresolution: %.17g\norigin: [%.17g, %.17g, 0.0]\nnegate: 0\n"
      "occupied_thresh: %g\nfree_thresh: %g\n",
      image_path.filename().string(), geometry.resolution_m, geometry.origin_x_m,
      geometry.origin_y_m, kWrittenOccupiedThreshold, kWrittenFreeThreshold);
  return WriteFile(yaml_path, yaml);
}

}  // namespace plumescout
