// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_writer.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"

namespace plumescout::lab {
namespace {

// The shortest decimal that reads back as the same number.
std::string Number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string Pair(Point2 point) {
  return absl::StrCat("[", Number(point.x_m), ", ", Number(point.y_m), "]");
}

std::string Quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

std::string WallLine(const Wall& wall) {
  std::string line = absl::StrCat("  - {from_m: ", Pair(wall.from), ", to_m: ", Pair(wall.to),
                                  ", thickness_m: ", Number(wall.thickness_m));
  const char* separator = ", doors: [";
  for (const Door& door : wall.doors) {
    absl::StrAppend(&line, separator, "{at_m: ", Number(door.at_m),
                    ", width_m: ", Number(door.width_m), "}");
    separator = ", ";
  }
  return absl::StrCat(line, wall.doors.empty() ? "}\n" : "]}\n");
}

std::string OpeningLine(const Opening& opening) {
  std::string line =
      absl::StrCat("  - {side: ", NameOf(opening.side), ", from_m: ", Number(opening.from_m),
                   ", to_m: ", Number(opening.to_m));
  if (opening.inflow_mps) absl::StrAppend(&line, ", inflow_mps: ", Number(*opening.inflow_mps));
  return line + "}\n";
}

std::string FanLine(const Fan& fan) {
  return absl::StrCat(
      "  - {position_m: ", Pair(fan.position), ", direction_rad: ", Number(fan.direction_rad),
      ", width_m: ", Number(fan.width_m), ", speed_mps: ", Number(fan.speed_mps), "}\n");
}

std::string SourceLine(const GasSource& source) {
  std::string line = absl::StrCat("  - {position_m: ", Pair({source.x_m, source.y_m}),
                                  ", rate_ppm_per_s: ", Number(source.rate_ppm_per_s));
  if (source.release == ReleaseSchedule{}) return line + "}\n";
  const std::pair<const char*, std::optional<double>> times[] = {
      {"start_s", source.release.start_s},
      {"end_s", source.release.end_s},
      {"on_s", source.release.on_s},
      {"off_s", source.release.off_s}};
  const char* separator = ", release: {";
  for (const auto& [key, time_s] : times) {
    if (!time_s) continue;
    absl::StrAppend(&line, separator, key, ": ", Number(*time_s));
    separator = ", ";
  }
  return line + "}}\n";
}

std::string FrameLines(const Layout& layout) {
  return absl::StrCat(
      "name: ", Quoted(layout.name), "\nsize_m: ", Pair({layout.size_x_m, layout.size_y_m}),
      "\nresolution_m: ", Number(layout.resolution_m), "\nborder_m: ", Number(layout.border_m),
      "\nsensor_height_m: ", Number(layout.sensor_height_m),
      "\ncritical_threshold_ppm: ", Number(layout.critical_threshold_ppm), "\n");
}

std::string GasLine(const GasParameters& gas) {
  return absl::StrCat("gas: {filaments_per_s: ", Number(gas.filaments_per_s),
                      ", initial_sigma_m: ", Number(gas.initial_sigma_m),
                      ", growth_m2_per_s: ", Number(gas.growth_m2_per_s),
                      ", diffusivity_m2_per_s: ", Number(gas.diffusivity_m2_per_s),
                      ", mixing_depth_m: ", Number(gas.mixing_depth_m), "}\n");
}

}  // namespace

std::string FormatLayout(const Layout& layout) {
  std::string yaml = FrameLines(layout);
  if (!layout.walls.empty()) absl::StrAppend(&yaml, "\nwalls:\n");
  for (const Wall& wall : layout.walls) absl::StrAppend(&yaml, WallLine(wall));
  if (!layout.boxes.empty()) absl::StrAppend(&yaml, "\nboxes:\n");
  for (const Rectangle& box : layout.boxes) {
    absl::StrAppend(&yaml, "  - {min_m: ", Pair(box.min), ", max_m: ", Pair(box.max), "}\n");
  }
  if (!layout.openings.empty()) absl::StrAppend(&yaml, "\nopenings:\n");
  for (const Opening& opening : layout.openings) absl::StrAppend(&yaml, OpeningLine(opening));
  if (!layout.fans.empty()) absl::StrAppend(&yaml, "\nfans:\n");
  for (const Fan& fan : layout.fans) absl::StrAppend(&yaml, FanLine(fan));
  absl::StrAppend(&yaml, "\nsources:\n");
  for (const GasSource& source : layout.sources) absl::StrAppend(&yaml, SourceLine(source));
  const Pose2& start = layout.start_pose;
  absl::StrAppend(&yaml, "\nstart_pose: {x_m: ", Number(start.x_m), ", y_m: ", Number(start.y_m),
                  ", yaw_rad: ", Number(start.yaw_rad), "}\n\n", GasLine(layout.gas));
  return yaml;
}

absl::Status WriteLayout(const Layout& layout, const std::string& path) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(layout));
  return WriteFile(path, FormatLayout(layout));
}

}  // namespace plumescout::lab
