// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/explorer.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "absl/status/statusor.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "formats/file_io.h"
#include "proto/convert/enums.h"
#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "proto/convert/options.h"
#include "proto/convert/plan.h"
#include "proto/convert/raster.h"

namespace plumescout::lab {
namespace {

using Json = nlohmann::ordered_json;

constexpr absl::string_view kPlace = "@mission@";
constexpr char kMission[] = "run";
constexpr double kCentimetresPerMetre = 100.0;  // ways are printed to the centimetre

std::string Base64(const google::protobuf::MessageLite& message) {
  return absl::Base64Escape(message.SerializeAsString());
}

v1::GetMapResponse MapOf(const Grid<CellState>& occupancy, const Grid<float>& mean_ppm) {
  v1::GetMapResponse proto;
  *proto.mutable_tile_geometry() = ToProto(occupancy.geometry());
  const CellRect whole = WholeRaster(occupancy.geometry());
  *proto.add_tiles() = EncodeStates(occupancy, whole, kDenseDeflate);
  *proto.add_tiles() = EncodeScaled(v1::MAP_LAYER_GAS_MEAN, mean_ppm, whole);
  return proto;
}

std::string EstimateOf(const MapSnapshot& map) {
  v1::GetMapResponse proto = MapOf(map.occupancy, map.gas_mean_ppm);
  *proto.mutable_status() = ToProto(map, map.occupancy.geometry(), kMission);
  *proto.add_tiles() = EncodeScaled(v1::MAP_LAYER_GAS_VARIANCE, map.gas_variance_ppm2,
                                    WholeRaster(map.occupancy.geometry()));
  return Base64(proto);
}

// Walls have no gas.
std::string TruthOf(const Scene& scene) {
  Grid<float> mean_ppm = scene.conc_mean_ppm;
  for (std::size_t i = 0; i < mean_ppm.size(); ++i) {
    if (scene.occupancy[i] != CellState::kFree) {
      mean_ppm[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return Base64(MapOf(scene.occupancy, mean_ppm));
}

// Verdicts as a byte a cell, row by row from the south; null: the mission had no objective.
Json ObjectiveOf(const std::optional<ObjectiveOutcome>& outcome) {
  if (!outcome) return nullptr;
  MissionOptions options;
  options.objective = outcome->asked;
  std::string verdicts;
  for (const ObjectiveVerdict verdict : outcome->verdicts.values()) {
    verdicts.push_back(static_cast<char>(ToProto(verdict)));
  }
  return {{"asked", Base64(ToProto(options).objective())},
          {"verdicts", absl::Base64Escape(verdicts)}};
}

double Rounded(double length_m) {
  return std::round(length_m * kCentimetresPerMetre) / kCentimetresPerMetre;
}

Json WayOf(const EpisodeResult& robot) {
  Json way = {{"robot", absl::StrCat("missions/", kMission, "/robots/", robot.robot)},
              {"points_m", Json::array()}};
  for (const DrivenPose& driven : robot.path) {
    Json point = {Rounded(driven.pose.x_m), Rounded(driven.pose.y_m)};
    if (way["points_m"].empty() || way["points_m"].back() != point) {
      way["points_m"].push_back(std::move(point));
    }
  }
  return way;
}

Json PlanEntries(const TeamResult& team) {
  Json plans = Json::array();
  for (const EpisodeResult& robot : team.robots) {
    for (const IssuedPlan& issued : robot.plans) {
      plans.push_back(
          {{"time_s", issued.time_s}, {"plan", Base64(ToProto(issued.plan, kMission))}});
    }
  }
  return plans;
}

}  // namespace

std::string ReadExplorerPage() {
  constexpr std::uint64_t kMaxBytes = 4'000'000;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return "";
  const std::filesystem::path page =
      program.parent_path().parent_path() / "share/plumescout/report.html";
  return ReadFile(page.string(), kMaxBytes).value_or("");
}

std::string MakeExplorer(absl::string_view page, const Run& run) {
  const std::size_t place = page.find(kPlace);
  if (place == absl::string_view::npos) return "";
  Json mission = {{"map", EstimateOf(run.final_map)},
                  {"truth", TruthOf(run.world.scene())},
                  {"plans", PlanEntries(run.team)},
                  {"ways", Json::array()},
                  {"homes_m", Json::array()},
                  {"sources_m", Json::array()},
                  {"objective", ObjectiveOf(run.objective)}};
  for (const EpisodeResult& robot : run.team.robots) {
    mission["ways"].push_back(WayOf(robot));
    const Json& way = mission["ways"].back()["points_m"];
    if (!way.empty()) mission["homes_m"].push_back(way.front());  // where it began
  }
  for (const GasSource& source : run.world.scene().sources) {
    mission["sources_m"].push_back({source.x_m, source.y_m});
  }
  // Numbers, names of robots and base64: nothing that ends the script it stands in.
  return absl::StrCat(page.substr(0, place), mission.dump(), page.substr(place + kPlace.size()));
}

}  // namespace plumescout::lab
