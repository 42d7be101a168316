// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/trial_store.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "formats/crc32c.h"
#include "formats/file_io.h"
#include "lab/formats/npy.h"
#include "lab/trials/calibration_json.h"
#include "proto/convert/options.h"

namespace plumescout::lab {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxRecordBytes = 16ULL << 20U;

json ToJson(const CurvePoint& point) {
  const MapMetrics& m = point.metrics;
  return {point.time_s,    m.completeness, m.rmse_ppm,
          m.rmse_zero_ppm, m.entropy_nats, m.critical_cells};
}

CurvePoint CurvePointFrom(const json& value) {
  CurvePoint point;
  point.time_s = value.at(0).get<double>();
  point.metrics.completeness = NumberFrom(value.at(1));
  point.metrics.rmse_ppm = NumberFrom(value.at(2));
  point.metrics.rmse_zero_ppm = NumberFrom(value.at(3));
  point.metrics.entropy_nats = NumberFrom(value.at(4));
  point.metrics.critical_cells = value.at(5).get<int>();
  return point;
}

json ToJson(const TeamRecord& team) {
  return {{"legs", team.legs},
          {"blocked_legs", team.blocked_legs},
          {"contacts", team.contacts},
          {"encounters", team.encounters},
          {"closest_m", team.closest_m ? json(*team.closest_m) : json()},
          {"waiting_s", team.waiting_s},
          {"robot_s", team.robot_s},
          {"plan_wall_s", team.plan_wall_s},
          {"blocked_by_robot", team.findings.blocked_by_robot},
          {"set_aside_for_robot", team.findings.set_aside_for_robot},
          {"deadlocks", team.findings.deadlocks},
          {"held_up", team.findings.held_up},
          {"alone_nats", team.findings.alone_nats},
          {"besides_nats", team.findings.besides_nats},
          {"paid_nats", team.findings.paid_nats},
          {"paid_twice_nats", team.findings.paid_twice_nats},
          {"unseen_goals", team.findings.unseen_goals},
          {"unseen_in_others_sight", team.findings.unseen_in_others_sight},
          {"unseen_paid_nats", team.findings.unseen_paid_nats},
          {"unseen_paid_twice_nats", team.findings.unseen_paid_twice_nats}};
}

TeamRecord TeamRecordFrom(const json& value) {
  TeamRecord team;
  value.at("legs").get_to(team.legs);
  value.at("blocked_legs").get_to(team.blocked_legs);
  value.at("contacts").get_to(team.contacts);
  value.at("encounters").get_to(team.encounters);
  if (const json& closest_m = value.at("closest_m"); !closest_m.is_null()) {
    team.closest_m = closest_m.get<double>();
  }
  value.at("waiting_s").get_to(team.waiting_s);
  value.at("robot_s").get_to(team.robot_s);
  value.at("plan_wall_s").get_to(team.plan_wall_s);
  TeamFindings& findings = team.findings;
  value.at("blocked_by_robot").get_to(findings.blocked_by_robot);
  value.at("set_aside_for_robot").get_to(findings.set_aside_for_robot);
  value.at("deadlocks").get_to(findings.deadlocks);
  value.at("held_up").get_to(findings.held_up);
  value.at("alone_nats").get_to(findings.alone_nats);
  value.at("besides_nats").get_to(findings.besides_nats);
  value.at("paid_nats").get_to(findings.paid_nats);
  value.at("paid_twice_nats").get_to(findings.paid_twice_nats);
  value.at("unseen_goals").get_to(findings.unseen_goals);
  value.at("unseen_in_others_sight").get_to(findings.unseen_in_others_sight);
  value.at("unseen_paid_nats").get_to(findings.unseen_paid_nats);
  value.at("unseen_paid_twice_nats").get_to(findings.unseen_paid_twice_nats);
  return team;
}

TrialRecord RecordFrom(const json& value) {
  TrialRecord record;
  for (const json& point : value.at("curve")) record.curve.push_back(CurvePointFrom(point));
  record.gas_readings = value.at("gas_readings").get<int>();
  record.distance_m = value.at("distance_m").get<double>();
  record.plans = value.at("plans").get<int>();
  record.collisions = value.at("collisions").get<int>();
  record.completed = value.at("completed").get<bool>();
  record.team = TeamRecordFrom(value.at("team"));
  record.calibration = CalibrationFrom(value.at("calibration"));
  if (value.contains("other_entropies_nats")) {
    const json& nats = value.at("other_entropies_nats");
    record.other_entropies = {NumberFrom(nats.at(0)), NumberFrom(nats.at(1))};
  }
  if (value.contains("peer_rmse_ppm")) {
    record.peer_rmse_ppm = value.at("peer_rmse_ppm").get<double>();
  }
  if (value.contains("second_field")) {
    record.second_field = CurvePointFrom(value.at("second_field")).metrics;
  }
  return record;
}

template <typename T>
std::uint32_t ChecksumOf(const std::vector<T>& values, std::uint32_t crc) {
  const absl::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                values.size() * sizeof(T));
  return Crc32c(bytes, crc);
}

}  // namespace

absl::StatusOr<TrialStore> TrialStore::Open(const std::string& folder) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(folder));
  return TrialStore(folder);
}

std::string TrialStore::JsonPath(const std::string& name) const {
  return absl::StrCat(folder_, "/", name, ".json");
}

std::string TrialStore::MapPath(const std::string& name, std::size_t map) const {
  return absl::StrCat(folder_, "/", name, ".map-", map, ".npy");
}

std::optional<TrialRecord> TrialStore::Find(const std::string& name, const std::string& fingerprint,
                                            const GridGeometry& geometry) const {
  const auto text = ReadFile(JsonPath(name), kMaxRecordBytes);
  if (!text.ok()) return std::nullopt;
  try {
    const json value = json::parse(*text);
    if (value.at("fingerprint").get<std::string>() != fingerprint) return std::nullopt;
    TrialRecord record = RecordFrom(value);
    for (std::size_t map = 0; map < value.at("maps").get<std::size_t>(); ++map) {
      auto array = ReadNpy(MapPath(name, map));
      if (!array.ok() || array->values.size() != geometry.size()) return std::nullopt;
      Grid<float>& field = record.mean_ppm.emplace_back(geometry);
      for (std::size_t i = 0; i < field.size(); ++i) field[i] = array->values[i];
    }
    return record;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

absl::Status TrialStore::Keep(const std::string& name, const std::string& fingerprint,
                              const TrialRecord& record) const {
  for (std::size_t map = 0; map < record.mean_ppm.size(); ++map) {
    const Grid<float>& field = record.mean_ppm[map];
    const std::size_t shape[] = {static_cast<std::size_t>(field.height()),
                                 static_cast<std::size_t>(field.width())};
    PLUMESCOUT_RETURN_IF_ERROR(WriteNpy(MapPath(name, map), shape, field.values()));
  }
  json value = {{"fingerprint", fingerprint},      {"gas_readings", record.gas_readings},
                {"distance_m", record.distance_m}, {"plans", record.plans},
                {"collisions", record.collisions}, {"completed", record.completed},
                {"maps", record.mean_ppm.size()},  {"curve", json::array()},
                {"team", ToJson(record.team)},     {"calibration", ToJson(record.calibration)}};
  if (record.peer_rmse_ppm) value["peer_rmse_ppm"] = *record.peer_rmse_ppm;
  if (record.second_field) {
    value["second_field"] = ToJson(CurvePoint{record.curve.back().time_s, *record.second_field});
  }
  if (const auto& other = record.other_entropies) {
    value["other_entropies_nats"] = {other->whole_building_nats, other->propagated_nats};
  }
  for (const CurvePoint& point : record.curve) value["curve"].push_back(ToJson(point));
  return WriteFile(JsonPath(name), value.dump());  // last: it says that the maps are there
}

std::uint32_t SceneChecksum(const Scene& scene) {
  std::uint32_t crc = ChecksumOf(scene.occupancy.values(), 0);
  crc = ChecksumOf(scene.conc_mean_ppm.values(), crc);
  crc = ChecksumOf(scene.series.counts, crc);
  const Pose2& start = scene.start_pose;
  return Crc32c(absl::StrCat(start.x_m, " ", start.y_m, " ", start.yaw_rad, " ",
                             scene.critical_threshold_ppm),
                crc);
}

std::string Fingerprint(const Trial& trial, std::uint32_t scene_checksum) {
  std::string times;
  for (const double time_s : trial.map_times_s) absl::StrAppend(&times, " ", time_s);
  if (trial.peer) {
    absl::StrAppend(&times, " peer ", trial.peer->kernel_width_m, " ",
                    trial.peer->confidence_scale);
  }
  if (trial.most_late_s > 0.0) absl::StrAppend(&times, " late ", trial.most_late_s);
  if (trial.ghosts) absl::StrAppend(&times, " ghosts");
  if (trial.rule) absl::StrAppend(&times, " rule ", NameOf(*trial.rule));
  if (const TrialRobot& robot = trial.robot; robot != TrialRobot{}) {
    absl::StrAppend(&times, " robot ", robot.lidar_range_m, " ", robot.plan_latency_s, " ",
                    robot.corrects_gas_lag, " ", robot.stops_without_frontier);
    if (robot.replan_period_s > 0.0) absl::StrAppend(&times, " replan ", robot.replan_period_s);
    if (robot.leaves_lag_to_mission) absl::StrAppend(&times, " lag left");
  }
  if (trial.second_field) {
    MissionOptions second;
    second.gas = *trial.second_field;
    absl::StrAppend(&times, " second ", Crc32c(ToProto(second).SerializeAsString()));
  }
  if (trial.tells_other_entropies) absl::StrAppend(&times, " entropies");
  return absl::StrFormat("mission %08x scene %08x robots %d seed %d duration %g maps%s",
                         Crc32c(ToProto(*trial.mission).SerializeAsString()), scene_checksum,
                         trial.robots, trial.seed, trial.duration_s, times);
}

}  // namespace plumescout::lab
