// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What the runner of the C++ client reads of a scenario, and what it tells of what came back; see
// README.md.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/mission_details.h"
#include "client/mission_history.h"
#include "client/operator_client.h"
#include "client/planner_client.h"
#include "client/robot_details.h"
#include "client/viewer_client.h"

namespace plumescout::client {

MissionOptions ReadOptions(const nlohmann::json& json);
MissionUpdate ReadUpdate(const nlohmann::json& with);
KeepOutChanged ReadChange(const nlohmann::json& with);
std::vector<GasSensor> ReadSensors(const nlohmann::json& list);
// Without a number.
Observation ReadObservation(const nlohmann::json& one, const nlohmann::json& scenario);
IntendedPath ReadPath(const nlohmann::json& with);
ProgressOutcome ReadOutcome(const std::string& name);
std::vector<MissionEventKind> ReadEventKinds(const nlohmann::json& names);
MapView ReadView(const nlohmann::json& with);

nlohmann::json TellOptional(const std::optional<double>& value);
nlohmann::json TellMission(const MissionDetails& mission);
nlohmann::json TellArea(const Polygon& area);
nlohmann::json TellEvent(const MissionEvent& event);
// The last of them, once no more follow.
absl::StatusOr<nlohmann::json> TellFigures(ViewerClient& viewer, const MissionId& mission);
nlohmann::json TellRobot(const RobotDetails& robot);
nlohmann::json TellStanding(const RobotStanding& standing);
nlohmann::json TellPlan(const Plan& plan);
nlohmann::json TellCheck(const TrajectoryVerdict& verdict);
nlohmann::json TellFrontier(const JudgedFrontier& frontier);
nlohmann::json TellLivePlan(const LivePlan& plan);
nlohmann::json TellGas(const GasAnswer& answer);
nlohmann::json TellMap(const MapSnapshot& map, const MapView& view);
// How much of the robot's log the map says is in it; -1: there is no such robot.
std::int64_t AppliedIn(const MapSnapshot& map, const RobotId& robot);

}  // namespace plumescout::client
