// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "absl/strings/string_view.h"
#include "server/access/principal.h"

namespace plumescout::server {

// Every method of every service.
enum class Rpc {
  kCreateMission,
  kGetMission,
  kListMissions,
  kDeleteMission,
  kUpdateMission,
  kPauseMission,
  kResumeMission,
  kFinishMission,
  kChangeKeepOutAreas,
  kRegisterRobot,
  kRemoveRobot,
  kGetRobot,
  kListRobots,
  kReleaseLease,
  kOrderHome,
  kWatchRobot,
  kStreamObservations,
  kBatchIngestObservations,
  kNextBestTrajectory,
  kStreamNextBestTrajectory,
  kCheckTrajectory,
  kListFrontiers,
  kReportProgress,
  kListPlans,
  kPlanTeam,
  kGetMap,
  kQueryGas,
  kWatchMap,
  kExportMission,
  kImportMission,
  kGetMissionHistory,
  kGetMissionFigures,
  kGetServerInfo,
  kDrainServer,
};
inline constexpr int kRpcCount = static_cast<int>(Rpc::kDrainServer) + 1;

// A row of the table of permissions. Tests compare the table with the services' descriptors.
struct RpcRow {
  Rpc rpc;
  absl::string_view service;  // "MissionService", of package plumescout.v1
  absl::string_view method;
  bool robot;
  bool viewer;
  bool op;         // operator; admins may do everything
  bool is_costly;  // takes a good part of a second of a core where missions are large
};

// In the order of Rpc.
const std::array<RpcRow, kRpcCount>& RpcTable();
const RpcRow& RowOf(Rpc rpc);

bool IsAllowed(Role role, Rpc rpc);

}  // namespace plumescout::server
