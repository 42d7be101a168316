// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_yaml.h"

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kMaxYamlBytes = 1 << 20;

absl::Status Mistyped(const YAML::Node& node, const std::string& path, const char* expected) {
  const std::string value = node.IsScalar() ? absl::StrCat(" = ", node.Scalar()) : "";
  return absl::InvalidArgumentError(absl::StrCat(path, value, " must be ", expected));
}

struct Key {
  bool required;
  std::function<absl::Status(const YAML::Node&, const std::string& path)> read;
};
using Keys = std::map<std::string, Key>;

absl::Status ReadMap(const YAML::Node& node, const std::string& path, const Keys& keys) {
  if (!node.IsMap()) return Mistyped(node, path.empty() ? "the layout" : path, "a map");
  const std::string prefix = path.empty() ? "" : path + ".";
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const auto name = entry.first.as<std::string>();
    const auto key = keys.find(name);
    if (key == keys.end()) return absl::InvalidArgumentError("unknown key " + prefix + name);
    if (!seen.insert(name).second) {
      return absl::InvalidArgumentError("repeated key " + prefix + name);
    }
    PLUMESCOUT_RETURN_IF_ERROR(key->second.read(entry.second, prefix + name));
  }
  for (const auto& [name, key] : keys) {
    if (key.required && !seen.contains(name)) {
      return absl::InvalidArgumentError("missing key " + prefix + name);
    }
  }
  return absl::OkStatus();
}

absl::Status Read(const YAML::Node& node, const std::string& path, double& value) {
  return YAML::convert<double>::decode(node, value) ? absl::OkStatus()
                                                    : Mistyped(node, path, "a number");
}

absl::Status Read(const YAML::Node& node, const std::string& path, std::optional<double>& value) {
  return Read(node, path, value.emplace());
}

absl::Status Read(const YAML::Node& node, const std::string& path, std::string& value) {
  if (!node.IsScalar()) return Mistyped(node, path, "text");
  value = node.Scalar();
  return absl::OkStatus();
}

absl::Status Read(const YAML::Node& node, const std::string& path, Point2& value) {
  const bool pair = node.IsSequence() && node.size() == 2 &&
                    YAML::convert<double>::decode(node[0], value.x_m) &&
                    YAML::convert<double>::decode(node[1], value.y_m);
  return pair ? absl::OkStatus() : Mistyped(node, path, "two numbers [x, y]");
}

absl::Status Read(const YAML::Node& node, const std::string& path, Side& value) {
  const std::optional<Side> side = node.IsScalar() ? SideNamed(node.Scalar()) : std::nullopt;
  if (!side) return Mistyped(node, path, "west, east, south or north");
  value = *side;
  return absl::OkStatus();
}

// Declared for Keys below; the sections and lists of them follow.
template <typename T>
Key Required(T& value);
template <typename T>
Key Optional(T& value);

absl::Status Read(const YAML::Node& node, const std::string& path, Door& door) {
  return ReadMap(node, path, {{"at_m", Required(door.at_m)}, {"width_m", Required(door.width_m)}});
}

template <typename T>
absl::Status Read(const YAML::Node& node, const std::string& path, std::vector<T>& values);

absl::Status Read(const YAML::Node& node, const std::string& path, Wall& wall) {
  return ReadMap(node, path,
                 {{"from_m", Required(wall.from)},
                  {"to_m", Required(wall.to)},
                  {"thickness_m", Optional(wall.thickness_m)},
                  {"doors", Optional(wall.doors)}});
}

absl::Status Read(const YAML::Node& node, const std::string& path, Rectangle& box) {
  return ReadMap(node, path, {{"min_m", Required(box.min)}, {"max_m", Required(box.max)}});
}

absl::Status Read(const YAML::Node& node, const std::string& path, Opening& opening) {
  return ReadMap(node, path,
                 {{"side", Required(opening.side)},
                  {"from_m", Required(opening.from_m)},
                  {"to_m", Required(opening.to_m)},
                  {"inflow_mps", Optional(opening.inflow_mps)}});
}

absl::Status Read(const YAML::Node& node, const std::string& path, Fan& fan) {
  return ReadMap(node, path,
                 {{"position_m", Required(fan.position)},
                  {"direction_rad", Required(fan.direction_rad)},
                  {"width_m", Required(fan.width_m)},
                  {"speed_mps", Required(fan.speed_mps)}});
}

absl::Status Read(const YAML::Node& node, const std::string& path, ReleaseSchedule& release) {
  return ReadMap(node, path,
                 {{"start_s", Optional(release.start_s)},
                  {"end_s", Optional(release.end_s)},
                  {"on_s", Optional(release.on_s)},
                  {"off_s", Optional(release.off_s)}});
}

absl::Status Read(const YAML::Node& node, const std::string& path, GasSource& source) {
  Point2 position;
  PLUMESCOUT_RETURN_IF_ERROR(ReadMap(node, path,
                                     {{"position_m", Required(position)},
                                      {"rate_ppm_per_s", Required(source.rate_ppm_per_s)},
                                      {"release", Optional(source.release)}}));
  source.x_m = position.x_m;
  source.y_m = position.y_m;
  return absl::OkStatus();
}

absl::Status Read(const YAML::Node& node, const std::string& path, Pose2& pose) {
  return ReadMap(node, path,
                 {{"x_m", Required(pose.x_m)},
                  {"y_m", Required(pose.y_m)},
                  {"yaw_rad", Required(pose.yaw_rad)}});
}

absl::Status Read(const YAML::Node& node, const std::string& path, GasParameters& gas) {
  return ReadMap(node, path,
                 {{"filaments_per_s", Optional(gas.filaments_per_s)},
                  {"initial_sigma_m", Optional(gas.initial_sigma_m)},
                  {"growth_m2_per_s", Optional(gas.growth_m2_per_s)},
                  {"diffusivity_m2_per_s", Optional(gas.diffusivity_m2_per_s)},
                  {"mixing_depth_m", Optional(gas.mixing_depth_m)}});
}

template <typename T>
absl::Status Read(const YAML::Node& node, const std::string& path, std::vector<T>& values) {
  if (!node.IsSequence()) return Mistyped(node, path, "a list");
  values.resize(node.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(Read(node[i], absl::StrCat(path, "[", i, "]"), values[i]));
  }
  return absl::OkStatus();
}

template <typename T>
Key Required(T& value) {
  return {true, [&value](const YAML::Node& node, const std::string& path) {
            return Read(node, path, value);
          }};
}

template <typename T>
Key Optional(T& value) {
  return {false, Required(value).read};
}

absl::Status ReadRoot(const YAML::Node& node, Layout& layout) {
  Point2 size;
  PLUMESCOUT_RETURN_IF_ERROR(
      ReadMap(node, "",
              {{"name", Required(layout.name)},
               {"size_m", Required(size)},
               {"resolution_m", Optional(layout.resolution_m)},
               {"border_m", Optional(layout.border_m)},
               {"walls", Optional(layout.walls)},
               {"boxes", Optional(layout.boxes)},
               {"openings", Optional(layout.openings)},
               {"fans", Optional(layout.fans)},
               {"sources", Required(layout.sources)},
               {"start_pose", Required(layout.start_pose)},
               {"sensor_height_m", Optional(layout.sensor_height_m)},
               {"critical_threshold_ppm", Optional(layout.critical_threshold_ppm)},
               {"gas", Optional(layout.gas)}}));
  layout.size_x_m = size.x_m;
  layout.size_y_m = size.y_m;
  for (std::size_t i = 0; i < layout.sources.size(); ++i) {
    layout.sources[i].id = static_cast<int>(i);
    layout.sources[i].z_m = layout.sensor_height_m;  // the model has no height of its own
  }
  return Validate(layout);
}

}  // namespace

absl::StatusOr<Layout> ParseLayout(const std::string& yaml) {
  Layout layout;
  try {  // yaml-cpp reports by exceptions: they end here
    PLUMESCOUT_RETURN_IF_ERROR(ReadRoot(YAML::Load(yaml), layout));
  } catch (const YAML::Exception& error) {
    return absl::InvalidArgumentError(error.what());
  }
  return layout;
}

absl::StatusOr<Layout> ReadLayout(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string yaml, ReadFile(path, kMaxYamlBytes));
  absl::StatusOr<Layout> layout = ParseLayout(yaml);
  if (layout.ok()) return layout;
  return absl::Status(layout.status().code(), absl::StrCat(path, ": ", layout.status().message()));
}

}  // namespace plumescout::lab
