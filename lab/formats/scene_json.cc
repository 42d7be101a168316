// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/scene_json.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxSide_cells = 1 << 13;  // 2^26 cells
constexpr int kMaxFrames = 1'000'000;
constexpr int kMaxId = 1'000'000;
constexpr std::size_t kMaxSources = 1000;
constexpr std::size_t kMaxOpenings = 1000;
constexpr double kMaxMagnitude = 1e9;  // of any number: metres, ppm, seconds

// One value of the document and its place in it, for error messages. The JSON library throws where
// a type is not the expected one: every access here asks first.
class Field {
 public:
  Field(const Json* json, std::string path) : json_(json), path_(std::move(path)) {}

  const std::string& path() const { return path_; }

  absl::StatusOr<Field> Member(const char* key) const {
    const std::string path = path_.empty() ? key : absl::StrCat(path_, ".", key);
    if (!Has(key)) return absl::InvalidArgumentError(absl::StrCat(path, " is missing"));
    return Field(&*json_->find(key), path);
  }
  bool Has(const char* key) const { return json_->is_object() && json_->contains(key); }

  absl::StatusOr<Field> Element(std::size_t index) const {
    const std::string path = absl::StrCat(path_, "[", index, "]");
    if (!json_->is_array() || index >= json_->size()) {
      return absl::InvalidArgumentError(absl::StrCat(path, " is missing"));
    }
    return Field(&(*json_)[index], path);
  }
  absl::StatusOr<std::size_t> ArraySize() const {
    if (!json_->is_array())
      return absl::InvalidArgumentError(absl::StrCat(Said(), " must be a list"));
    return json_->size();
  }

  absl::StatusOr<double> Number() const {
    const double value = json_->is_number() ? json_->get<double>() : std::nan("");
    if (std::abs(value) <= kMaxMagnitude) return value;
    return absl::InvalidArgumentError(absl::StrCat(Said(), " must be a number within 1e9"));
  }
  absl::StatusOr<int> Integer(int low, int high) const {
    const auto value = json_->is_number_integer() ? json_->get<std::int64_t>() : std::int64_t{-1};
    if (value >= low && value <= high) return static_cast<int>(value);
    return absl::InvalidArgumentError(
        absl::StrCat(Said(), " must be a whole number in [", low, ", ", high, "]"));
  }
  absl::StatusOr<std::string> Text() const {
    if (json_->is_string()) return json_->get<std::string>();
    return absl::InvalidArgumentError(absl::StrCat(Said(), " must be a text"));
  }
  // A file of the scene's own folder.
  absl::StatusOr<std::string> FileName() const {
    PLUMESCOUT_ASSIGN_OR_RETURN(std::string name, Text());
    if (!name.empty() && name != ".." && !absl::StrContains(name, "/")) return name;
    return absl::InvalidArgumentError(absl::StrCat(Said(), " must name a file of the same folder"));
  }

 private:
  // The field and its value, as far as that is short.
  std::string Said() const {
    constexpr std::size_t kShort = 40;
    const std::string value =
        json_->is_structured() ? "" : json_->dump(-1, ' ', false, Json::error_handler_t::replace);
    return value.empty() || value.size() > kShort ? path_ : absl::StrCat(path_, " = ", value);
  }

  const Json* json_;
  std::string path_;
};

absl::StatusOr<double> NumberAt(const Field& object, const char* key) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field field, object.Member(key));
  return field.Number();
}

absl::StatusOr<int> IntegerAt(const Field& object, const char* key, int low, int high) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field field, object.Member(key));
  return field.Integer(low, high);
}

absl::StatusOr<std::string> FileNameAt(const Field& object, const char* key) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field field, object.Member(key));
  return field.FileName();
}

absl::StatusOr<GridGeometry> ParseGeometry(const Field& root) {
  GridGeometry geometry;
  PLUMESCOUT_ASSIGN_OR_RETURN(geometry.resolution_m, NumberAt(root, "resolution_m"));
  PLUMESCOUT_ASSIGN_OR_RETURN(geometry.width, IntegerAt(root, "width", 1, kMaxSide_cells));
  PLUMESCOUT_ASSIGN_OR_RETURN(geometry.height, IntegerAt(root, "height", 1, kMaxSide_cells));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field origin, root.Member("origin"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field origin_x, origin.Element(0));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field origin_y, origin.Element(1));
  PLUMESCOUT_ASSIGN_OR_RETURN(geometry.origin_x_m, origin_x.Number());
  PLUMESCOUT_ASSIGN_OR_RETURN(geometry.origin_y_m, origin_y.Number());
  return geometry;
}

absl::StatusOr<std::optional<double>> OptionalNumberAt(const Field& object, const char* key) {
  if (!object.Has(key)) return std::optional<double>();
  return NumberAt(object, key);
}

absl::StatusOr<ReleaseSchedule> ParseRelease(const Field& field) {
  ReleaseSchedule release;
  PLUMESCOUT_ASSIGN_OR_RETURN(release.start_s, OptionalNumberAt(field, "start_s"));
  PLUMESCOUT_ASSIGN_OR_RETURN(release.end_s, OptionalNumberAt(field, "end_s"));
  PLUMESCOUT_ASSIGN_OR_RETURN(release.on_s, OptionalNumberAt(field, "on_s"));
  PLUMESCOUT_ASSIGN_OR_RETURN(release.off_s, OptionalNumberAt(field, "off_s"));
  const absl::Status valid = Validate(release);
  if (valid.ok()) return release;
  return absl::InvalidArgumentError(absl::StrCat(field.path(), ".", valid.message()));
}

absl::StatusOr<GasSource> ParseSource(const Field& field) {
  GasSource source;
  PLUMESCOUT_ASSIGN_OR_RETURN(source.id, IntegerAt(field, "id", 0, kMaxId));
  PLUMESCOUT_ASSIGN_OR_RETURN(source.x_m, NumberAt(field, "x"));
  PLUMESCOUT_ASSIGN_OR_RETURN(source.y_m, NumberAt(field, "y"));
  PLUMESCOUT_ASSIGN_OR_RETURN(source.z_m, NumberAt(field, "z"));
  PLUMESCOUT_ASSIGN_OR_RETURN(source.rate_ppm_per_s, NumberAt(field, "rate_ppm_per_s"));
  if (field.Has("release")) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Field release, field.Member("release"));
    PLUMESCOUT_ASSIGN_OR_RETURN(source.release, ParseRelease(release));
  }
  return source;
}

absl::StatusOr<std::vector<GasSource>> ParseSources(const Field& list) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::size_t count, list.ArraySize());
  if (count > kMaxSources) return absl::InvalidArgumentError("more than 1000 sources");
  std::vector<GasSource> sources;
  for (std::size_t i = 0; i < count; ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Field element, list.Element(i));
    PLUMESCOUT_ASSIGN_OR_RETURN(const GasSource source, ParseSource(element));
    sources.push_back(source);
  }
  return sources;
}

absl::StatusOr<Side> ParseSide(const Field& field) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string name, field.Text());
  if (const std::optional<Side> side = SideNamed(name)) return *side;
  return absl::InvalidArgumentError(
      absl::StrCat(field.path(), " = ", name, " must be west, east, south or north"));
}

absl::StatusOr<Opening> ParseOpening(const Field& field) {
  Opening opening;
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field side, field.Member("side"));
  PLUMESCOUT_ASSIGN_OR_RETURN(opening.side, ParseSide(side));
  PLUMESCOUT_ASSIGN_OR_RETURN(opening.from_m, NumberAt(field, "from_m"));
  PLUMESCOUT_ASSIGN_OR_RETURN(opening.to_m, NumberAt(field, "to_m"));
  if (!field.Has("inflow_mps")) return opening;
  PLUMESCOUT_ASSIGN_OR_RETURN(opening.inflow_mps, NumberAt(field, "inflow_mps"));
  return opening;
}

absl::StatusOr<std::vector<Opening>> ParseOpenings(const Field& list) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::size_t count, list.ArraySize());
  if (count > kMaxOpenings) return absl::InvalidArgumentError("more than 1000 openings");
  std::vector<Opening> openings;
  for (std::size_t i = 0; i < count; ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Field element, list.Element(i));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Opening opening, ParseOpening(element));
    openings.push_back(opening);
  }
  return openings;
}

absl::StatusOr<Pose2> ParsePose(const Field& field) {
  Pose2 pose;
  PLUMESCOUT_ASSIGN_OR_RETURN(pose.x_m, NumberAt(field, "x"));
  PLUMESCOUT_ASSIGN_OR_RETURN(pose.y_m, NumberAt(field, "y"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const double yaw_rad, NumberAt(field, "yaw"));
  pose.yaw_rad = WrapAngle_rad(yaw_rad);
  return pose;
}

absl::Status ParseSeries(const Field& field, SceneDescription& description) {
  ConcentrationSeries& series = description.scene.series;
  PLUMESCOUT_ASSIGN_OR_RETURN(description.files.series, FileNameAt(field, "file"));
  PLUMESCOUT_ASSIGN_OR_RETURN(series.frames, IntegerAt(field, "frames", 1, kMaxFrames));
  PLUMESCOUT_ASSIGN_OR_RETURN(series.dt_s, NumberAt(field, "dt_s"));
  PLUMESCOUT_ASSIGN_OR_RETURN(series.scale_ppm_per_count, NumberAt(field, "scale_ppm_per_count"));
  const GridGeometry& geometry = description.scene.geometry();
  const int expected[] = {series.frames, geometry.height, geometry.width};
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field shape, field.Member("shape"));
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Field length, shape.Element(i));
    PLUMESCOUT_RETURN_IF_ERROR(length.Integer(expected[i], expected[i]).status());
  }
  return absl::OkStatus();
}

absl::StatusOr<SceneDescription> ParseDescription(const Field& root) {
  SceneDescription description;
  Scene& scene = description.scene;
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field name, root.Member("name"));
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.name, name.Text());
  PLUMESCOUT_ASSIGN_OR_RETURN(const GridGeometry geometry, ParseGeometry(root));
  scene.occupancy = Grid<CellState>(geometry);
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.sensor_height_m, NumberAt(root, "sensor_height_m"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field sources, root.Member("sources"));
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.sources, ParseSources(sources));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field start_pose, root.Member("start_pose"));
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.start_pose, ParsePose(start_pose));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Field series, root.Member("time_series"));
  PLUMESCOUT_RETURN_IF_ERROR(ParseSeries(series, description));
  if (root.Has("wind")) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Field wind, root.Member("wind"));
    PLUMESCOUT_ASSIGN_OR_RETURN(description.files.wind, FileNameAt(wind, "file"));
  }
  if (root.Has("openings")) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Field openings, root.Member("openings"));
    PLUMESCOUT_ASSIGN_OR_RETURN(scene.openings, ParseOpenings(openings));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(scene.critical_threshold_ppm,
                              NumberAt(root, "critical_threshold_ppm"));
  return description;
}

Json FormatRelease(const ReleaseSchedule& release) {
  Json json = Json::object();
  if (release.start_s) json["start_s"] = *release.start_s;
  if (release.end_s) json["end_s"] = *release.end_s;
  if (release.on_s) json["on_s"] = *release.on_s;
  if (release.off_s) json["off_s"] = *release.off_s;
  return json;
}

Json FormatSources(const std::vector<GasSource>& sources) {
  Json list = Json::array();
  for (const GasSource& source : sources) {
    list.push_back({{"id", source.id},
                    {"x", source.x_m},
                    {"y", source.y_m},
                    {"z", source.z_m},
                    {"rate_ppm_per_s", source.rate_ppm_per_s}});
    if (source.release != ReleaseSchedule{}) {
      list.back()["release"] = FormatRelease(source.release);
    }
  }
  return list;
}

Json FormatOpenings(const std::vector<Opening>& openings) {
  Json list = Json::array();
  for (const Opening& opening : openings) {
    list.push_back({{"side", std::string(NameOf(opening.side))},
                    {"from_m", opening.from_m},
                    {"to_m", opening.to_m}});
    if (opening.inflow_mps) list.back()["inflow_mps"] = *opening.inflow_mps;
  }
  return list;
}

}  // namespace

absl::StatusOr<SceneDescription> ParseSceneJson(absl::string_view text) {
  constexpr bool kAllowExceptions = false;
  const Json json = Json::parse(text.begin(), text.end(), nullptr, kAllowExceptions);
  if (json.is_discarded()) return absl::DataLossError("no JSON document");
  return ParseDescription(Field(&json, ""));
}

std::string FormatSceneJson(const Scene& scene, const SceneFiles& files) {
  const GridGeometry& geometry = scene.geometry();
  Json json = {
      {"name", scene.name},
      {"size_m", {geometry.width * geometry.resolution_m, geometry.height * geometry.resolution_m}},
      {"resolution_m", geometry.resolution_m},
      {"width", geometry.width},
      {"height", geometry.height},
      {"origin", {geometry.origin_x_m, geometry.origin_y_m}},
      {"frame", "map; x right, y up, metres; arrays are [iy][ix], iy=0 at min y"},
      {"sensor_height_m", scene.sensor_height_m},
      {"units", "ppm"},
      {"sources", FormatSources(scene.sources)},
      {"start_pose",
       {{"x", scene.start_pose.x_m},
        {"y", scene.start_pose.y_m},
        {"yaw", scene.start_pose.yaw_rad}}},
      {"time_series",
       {{"file", files.series},
        {"frames", scene.series.frames},
        {"dt_s", scene.series.dt_s},
        {"dtype", "uint16 little endian"},
        {"shape", {scene.series.frames, geometry.height, geometry.width}},
        {"scale_ppm_per_count", scene.series.scale_ppm_per_count}}},
      {"critical_threshold_ppm", scene.critical_threshold_ppm},
  };
  if (files.wind) json["wind"] = {{"file", *files.wind}};
  if (!scene.openings.empty()) json["openings"] = FormatOpenings(scene.openings);
  constexpr int kIndent = 1;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace plumescout::lab
