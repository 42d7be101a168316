// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/clients/told.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/mission_messages.h"
#include "core/types/status_macros.h"
#include "formats/file_sum.h"
#include "proto/convert/enums.h"

namespace plumescout::client {
namespace {

using Json = nlohmann::json;

// The name of an enum of the wire without its prefix.
Json Word(const std::string& name, const std::string& prefix) { return name.substr(prefix.size()); }

Json PhaseWord(MissionPhase phase) {
  return Word(v1::MissionPhase_Name(ToProto(phase)), "MISSION_PHASE_");
}

Json GoalWord(GoalKind kind) { return Word(v1::GoalKind_Name(ToProto(kind)), "GOAL_KIND_"); }

Json ReasonWord(const std::optional<RejectedGoal>& rejected) {
  if (!rejected) return nullptr;
  return Word(v1::RejectedGoal::Reason_Name(ToProto(rejected->reason)), "REASON_");
}

Json StateWord(MissionState state) {
  switch (state) {
    case MissionState::kRunning:
      return "RUNNING";
    case MissionState::kPaused:
      return "PAUSED";
    case MissionState::kFinished:
      return "FINISHED";
    case MissionState::kRecovering:
      return "RECOVERING";
    case MissionState::kSleeping:
      return "SLEEPING";
    case MissionState::kElsewhere:
      return "ELSEWHERE";
    case MissionState::kDamaged:
      return "DAMAGED";
    case MissionState::kUnknown:
      break;
  }
  return "UNSPECIFIED";
}

Pose2 ReadPose(const Json& pose) { return {pose[0], pose[1], pose[2]}; }

Scan ReadScan(const std::string& name, const Json& scenario) {
  const Json& form = scenario["scan"];
  Scan scan{.start_angle_rad = form["start_angle_rad"],
            .angle_step_rad = form["angle_step_rad"],
            .max_range_m = form["max_range_m"]};
  for (const Json& range : scenario["ranges_m"][name]) {
    scan.ranges_m.push_back(range.is_null()     ? std::numeric_limits<float>::quiet_NaN()
                            : range.is_string() ? std::numeric_limits<float>::infinity()
                                                : range.get<float>());
  }
  return scan;
}

std::string Sha256(const std::string& bytes) {
  FileSum sum;
  sum.Add(bytes);
  return absl::BytesToHexString(sum.TakeSha256());
}

template <typename Number>
void Append(Number number, std::string& bytes) {  // of a machine that is little-endian
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

std::string Sha256(const Grid<CellState>& cells) {
  std::string bytes;
  for (const CellState cell : cells.values()) bytes.push_back(static_cast<char>(cell));
  return Sha256(bytes);
}

std::string Sha256(const Grid<float>& cells) {
  constexpr std::uint32_t kNan = 0x7fc00000;
  std::string bytes;
  for (const float cell : cells.values()) {
    if (std::isnan(cell)) {
      Append(kNan, bytes);
    } else {
      Append(cell, bytes);
    }
  }
  return Sha256(bytes);
}

}  // namespace

MissionOptions ReadOptions(const Json& json) {
  MissionOptions options;
  if (json.empty()) return options;
  const Json flat = json.flatten();
  for (const auto& [name, value] : flat.items()) {
    if (name == "/planning/speed_mps") {
      options.planning.speed_mps = value;
    } else if (name == "/occupancy/resolution_m") {
      options.occupancy.resolution_m = value;
    } else if (name == "/seed") {
      options.seed = std::stoull(value.get<std::string>());
    } else {
      throw std::invalid_argument(absl::StrCat("this runner does not know the option ", name));
    }
  }
  return options;
}

MissionUpdate ReadUpdate(const Json& with) {
  MissionUpdate update;
  if (with.contains("idle_time_to_live_s")) {
    const Json& idle_s = with["idle_time_to_live_s"];
    update.idle_time_to_live =
        idle_s.is_null() ? absl::InfiniteDuration() : absl::Seconds(idle_s.get<double>());
  }
  if (with.contains("event_retention")) {
    update.event_retention =
        with["event_retention"] == "ALL" ? EventRetention::kAll : EventRetention::kSinceSnapshot;
  }
  return update;
}

KeepOutChanged ReadChange(const Json& with) {
  KeepOutChanged change;
  change.deleted = with.value("deleted", std::vector<std::string>());
  const Json added = with.value("added", Json::object());
  for (const auto& [name, corners] : added.items()) {
    Polygon area{{}, name};
    for (const Json& corner : corners) area.vertices.push_back({corner[0], corner[1]});
    change.added.push_back(std::move(area));
  }
  return change;
}

std::vector<GasSensor> ReadSensors(const Json& list) {
  std::vector<GasSensor> sensors;
  for (const Json& one : list) {
    sensors.push_back({.id = one["id"],
                       .robot_from_sensor = {one["ahead_m"], one["left_m"]},
                       .stddev_ppm = one["stddev_ppm"]});
  }
  return sensors;
}

Observation ReadObservation(const Json& one, const Json& scenario) {
  Observation observation;
  observation.sample_time_ns = one["time_ns"];
  if (one.contains("pose")) observation.pose = ReadPose(one["pose"]);
  if (one.contains("scan")) {
    observation.payload = ReadScan(one["scan"], scenario);
  } else if (one.contains("gas_ppm")) {
    const double stddev_ppm = one.value("stddev_ppm", 0.0);
    observation.payload = GasReading{.concentration_ppm = one["gas_ppm"],
                                     .variance_ppm2 = stddev_ppm * stddev_ppm,
                                     .sensor = one.value("sensor", 0)};
  } else if (one.contains("correction")) {
    PoseCorrection correction;
    for (const Json& anchor : one["correction"]) {
      correction.anchors.push_back({anchor[0], ReadPose(anchor[1])});
    }
    observation.payload = correction;
  } else {
    observation.payload = RobotStatus{.battery_share = one["battery_share"]};
  }
  return observation;
}

IntendedPath ReadPath(const Json& with) {
  IntendedPath path;
  for (const Json& vertex : with["path"]) path.vertices.push_back({vertex[0], vertex[1]});
  v1::GoalKind kind = v1::GOAL_KIND_UNSPECIFIED;
  v1::GoalKind_Parse("GOAL_KIND_" + with["goal_kind"].get<std::string>(), &kind);
  path.goal_kind = FromProto(kind, "goal_kind").value();
  return path;
}

ProgressOutcome ReadOutcome(const std::string& name) {
  v1::ReportProgressRequest::Outcome outcome = v1::ReportProgressRequest::OUTCOME_UNSPECIFIED;
  v1::ReportProgressRequest::Outcome_Parse("OUTCOME_" + name, &outcome);
  return FromProto(outcome, "outcome").value();
}

std::vector<MissionEventKind> ReadEventKinds(const Json& names) {
  std::vector<MissionEventKind> kinds;
  for (const Json& name : names) {
    v1::MissionEvent event;
    v1::MissionEventKind kind = v1::MISSION_EVENT_KIND_UNSPECIFIED;
    v1::MissionEventKind_Parse("MISSION_EVENT_KIND_" + name.get<std::string>(), &kind);
    event.set_kind(kind);
    kinds.push_back(EventFromProto(event).value().kind);
  }
  return kinds;
}

MapView ReadView(const Json& with) {
  MapView view{.full_precision = with.value("full_precision", true),
               .level_of_detail = with.value("level_of_detail", 0)};
  if (with.contains("region")) {
    const Json& sides = with["region"];
    view.region = Rectangle{{sides[0], sides[1]}, {sides[2], sides[3]}};
  }
  if (!with.contains("layers")) return view;
  view.occupancy = view.gas_mean = view.gas_variance = false;
  for (const Json& layer : with["layers"]) {
    if (layer == "OCCUPANCY") view.occupancy = true;
    if (layer == "GAS_MEAN") view.gas_mean = true;
    if (layer == "GAS_VARIANCE") view.gas_variance = true;
  }
  return view;
}

Json TellOptional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json TellMission(const MissionDetails& mission) {
  const bool lives_on = mission.idle_time_to_live == absl::InfiniteDuration();
  return {{"mission", mission.id},
          {"state", StateWord(mission.state)},
          {"phase", PhaseWord(mission.phase)},
          {"robot_count", mission.robot_count},
          {"event_retention",
           mission.event_retention == EventRetention::kAll ? "ALL" : "SINCE_SNAPSHOT"},
          {"idle_time_to_live_s",
           lives_on ? Json() : Json(absl::ToDoubleSeconds(mission.idle_time_to_live))}};
}

Json TellArea(const Polygon& area) {
  Json corners = Json::array();
  for (const Point2& corner : area.vertices) corners.push_back({corner.x_m, corner.y_m});
  return {{"name", area.name}, {"corners", corners}};
}

Json TellEvent(const MissionEvent& event) {
  return {{"kind", Word(v1::MissionEventKind_Name(ToProto(event.kind)), "MISSION_EVENT_KIND_")},
          {"robot", event.robot.empty() ? Json() : Json(event.robot)}};
}

absl::StatusOr<Json> TellFigures(ViewerClient& viewer, const MissionId& mission) {
  constexpr absl::Duration kPatience = absl::Seconds(60);
  constexpr absl::Duration kPause = absl::Milliseconds(20);  // or a caller has used up its rate
  const absl::Time end = absl::Now() + kPatience;
  PLUMESCOUT_ASSIGN_OR_RETURN(FigureHistory history, viewer.GetFigures(mission));
  while (history.more_follow) {
    if (absl::Now() > end) return absl::DeadlineExceededError("figures are still being made");
    absl::SleepFor(kPause);
    PLUMESCOUT_ASSIGN_OR_RETURN(history, viewer.GetFigures(mission));
  }
  if (history.figures.empty()) return absl::NotFoundError("no figures are told");
  const MissionFigures& last = history.figures.back();
  Json readings = Json::array();
  for (const GasFigures& gas : last.gases) readings.push_back(gas.in_posterior);
  Json robots = Json::array();
  for (const auto& [robot, sequence] : last.applied_sequences) robots.push_back(robot);
  return Json{{"known_area_m2", last.known_area_m2}, {"readings", readings}, {"robots", robots}};
}

Json TellRobot(const RobotDetails& robot) {
  const RobotState& state = robot.state;
  const Json pose = {state.pose.x_m, state.pose.y_m, state.pose.yaw_rad};
  return {{"robot", state.id},
          {"leased", robot.leased},
          {"applied_sequence", state.applied_sequence},
          {"rejected_count", state.rejected_observations},
          {"battery_share", TellOptional(state.battery_share)},
          {"ordered_home", state.ordered_home},
          {"live_plan", robot.live_plan.has_value()},
          {"pose", state.has_pose ? pose : Json()}};
}

Json TellStanding(const RobotStanding& standing) {
  Json flags = Json::array();
  if (standing.paused) flags.push_back("paused");
  if (standing.finished) flags.push_back("finished");
  if (standing.ordered_home) flags.push_back("ordered_home");
  if (standing.frame_suspect) flags.push_back("frame_suspect");
  if (standing.silent) flags.push_back("silent");
  if (standing.leased) flags.push_back("leased");
  return {{"standing", flags}};
}

Json TellPlan(const Plan& plan) {
  std::string numbers;
  for (const Waypoint& point : plan.trajectory.waypoints) {
    for (const double number : {point.pose.x_m, point.pose.y_m, point.pose.yaw_rad,
                                point.arrival_time_s, point.dwell_s, point.speed_mps}) {
      Append(number, numbers);
    }
  }
  const bool stays = plan.chosen < 0;
  return {
      {"named", plan.id > 0},
      {"end", Word(v1::Plan::End_Name(ToProto(plan.end)), "END_")},
      {"phase", PhaseWord(plan.phase)},
      {"goal_kind",
       stays ? Json() : GoalWord(plan.candidates[static_cast<std::size_t>(plan.chosen)].goal.kind)},
      {"length_m", plan.trajectory.length_m},
      {"duration_s", plan.trajectory.duration_s},
      {"waypoints", plan.trajectory.waypoints.size()},
      {"sha256", Sha256(numbers)}};
}

Json TellCheck(const TrajectoryVerdict& verdict) {
  Json blocked;
  if (verdict.blockage) {
    blocked = Word(v1::CellState_Name(ToProto(verdict.blockage->state)), "CELL_STATE_");
  }
  return {{"blocked", blocked},
          {"rejected", ReasonWord(verdict.rejection)},
          {"length_m", verdict.rest ? Json(verdict.rest->length_m) : Json()}};
}

Json TellFrontier(const JudgedFrontier& frontier) {
  return {{"kind", GoalWord(frontier.goal.kind)},        {"reason", ReasonWord(frontier.rejection)},
          {"travel_m", TellOptional(frontier.travel_m)}, {"x_m", frontier.goal.position.x_m},
          {"y_m", frontier.goal.position.y_m},           {"cells", frontier.goal.frontier_cells}};
}

Json TellLivePlan(const LivePlan& plan) {
  return {{"robot", plan.robot},
          {"goal_kind", GoalWord(plan.goal_kind)},
          {"x_m", plan.goal.x_m},
          {"y_m", plan.goal.y_m},
          {"waypoints", plan.trajectory.waypoints.size()}};
}

Json TellGas(const GasAnswer& answer) {
  Json means = Json::array();
  Json variances = Json::array();
  Json distances = Json::array();
  Json ages = Json::array();
  for (const GasAtPlace& gas : answer.gas) {
    std::optional<double> distance_m;
    std::optional<double> age_s;
    if (gas.nearest_reading) distance_m = gas.nearest_reading->distance_m;
    if (gas.nearest_reading && gas.nearest_reading->time_ns) {
      age_s = static_cast<double>(answer.sample_time_ns - *gas.nearest_reading->time_ns) / 1e9;
    }
    means.push_back(TellOptional(gas.mean_ppm));
    variances.push_back(TellOptional(gas.variance_ppm2));
    distances.push_back(TellOptional(distance_m));
    ages.push_back(TellOptional(age_s));
  }
  return Json{{"mean_ppm", means},
              {"variance_ppm2", variances},
              {"nearest_reading_m", distances},
              {"nearest_reading_age_s", ages}};
}

Json TellMap(const MapSnapshot& map, const MapView& view) {
  const GridGeometry& geometry = map.occupancy.geometry();
  Json robots = Json::array();
  for (const RobotState& robot : map.robots) robots.push_back(robot.id);
  Json told = {{"rows", geometry.height},
               {"columns", geometry.width},
               {"resolution_m", geometry.resolution_m},
               {"origin", {geometry.origin_x_m, geometry.origin_y_m}},
               {"robots", robots},
               {"reading_count", map.gas_counters.readings},
               {"frontier_count", map.frontiers.size()},
               {"phase", PhaseWord(map.phase)}};
  if (view.occupancy) told["occupancy_sha256"] = Sha256(map.occupancy);
  if (view.gas_mean) told["gas_mean_sha256"] = Sha256(map.gas_mean_ppm);
  if (view.gas_variance) told["gas_variance_sha256"] = Sha256(map.gas_variance_ppm2);
  return told;
}

std::int64_t AppliedIn(const MapSnapshot& map, const RobotId& robot) {
  for (const RobotState& state : map.robots) {
    if (state.id == robot) return state.applied_sequence;
  }
  return -1;
}

}  // namespace plumescout::client
