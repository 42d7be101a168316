// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/rpc.h"

#include <cstddef>

namespace plumescout::server {
namespace {

constexpr bool kYes = true;
constexpr bool kNo = false;

constexpr std::array<RpcRow, kRpcCount> kTable = {{
    // rpc, service, method,                                                   robot viewer operator
    {Rpc::kCreateMission, "MissionService", "CreateMission", kNo, kNo, kYes},
    {Rpc::kGetMission, "MissionService", "GetMission", kYes, kYes, kYes},
    {Rpc::kListMissions, "MissionService", "ListMissions", kYes, kYes, kYes},
    {Rpc::kDeleteMission, "MissionService", "DeleteMission", kNo, kNo, kYes},
    {Rpc::kUpdateMission, "MissionService", "UpdateMission", kNo, kNo, kYes},
    {Rpc::kPauseMission, "MissionService", "PauseMission", kNo, kNo, kYes},
    {Rpc::kResumeMission, "MissionService", "ResumeMission", kNo, kNo, kYes},
    {Rpc::kFinishMission, "MissionService", "FinishMission", kNo, kNo, kYes},
    {Rpc::kChangeKeepOutAreas, "MissionService", "ChangeKeepOutAreas", kNo, kNo, kYes},
    {Rpc::kRegisterRobot, "RobotService", "RegisterRobot", kYes, kNo, kYes},
    {Rpc::kRemoveRobot, "RobotService", "RemoveRobot", kYes, kNo, kYes},
    {Rpc::kGetRobot, "RobotService", "GetRobot", kYes, kYes, kYes},
    {Rpc::kListRobots, "RobotService", "ListRobots", kYes, kYes, kYes},
    {Rpc::kReleaseLease, "RobotService", "ReleaseLease", kYes, kNo, kYes},
    {Rpc::kOrderHome, "RobotService", "OrderHome", kNo, kNo, kYes},
    {Rpc::kWatchRobot, "RobotService", "WatchRobot", kYes, kNo, kYes},
    {Rpc::kStreamObservations, "IngestService", "StreamObservations", kYes, kNo, kYes},
    {Rpc::kBatchIngestObservations, "IngestService", "BatchIngestObservations", kYes, kNo, kYes},
    {Rpc::kNextBestTrajectory, "PlanningService", "NextBestTrajectory", kYes, kNo, kYes},
    {Rpc::kStreamNextBestTrajectory, "PlanningService", "StreamNextBestTrajectory", kYes, kNo,
     kYes},
    {Rpc::kCheckTrajectory, "PlanningService", "CheckTrajectory", kYes, kNo, kYes},
    {Rpc::kListFrontiers, "PlanningService", "ListFrontiers", kYes, kYes, kYes},
    {Rpc::kReportProgress, "PlanningService", "ReportProgress", kYes, kNo, kYes},
    {Rpc::kListPlans, "PlanningService", "ListPlans", kYes, kYes, kYes},
    {Rpc::kPlanTeam, "PlanningService", "PlanTeam", kNo, kNo, kYes},
    {Rpc::kGetMap, "MapService", "GetMap", kYes, kYes, kYes},
    {Rpc::kQueryGas, "MapService", "QueryGas", kYes, kYes, kYes},
    {Rpc::kWatchMap, "MapService", "WatchMap", kYes, kYes, kYes},
    {Rpc::kExportMission, "SnapshotService", "ExportMission", kNo, kNo, kYes},
    {Rpc::kImportMission, "SnapshotService", "ImportMission", kNo, kNo, kYes},
    {Rpc::kGetMissionHistory, "SnapshotService", "GetMissionHistory", kNo, kYes, kYes},
    {Rpc::kGetServerInfo, "SystemService", "GetServerInfo", kYes, kYes, kYes},
    {Rpc::kDrainServer, "SystemService", "DrainServer", kNo, kNo, kNo},
}};

constexpr bool IsInOrder() {
  for (std::size_t i = 0; i < kTable.size(); ++i) {
    if (static_cast<std::size_t>(kTable[i].rpc) != i) return false;
  }
  return true;
}
static_assert(IsInOrder(), "the table has a row for each Rpc, in their order");

}  // namespace

const std::array<RpcRow, kRpcCount>& RpcTable() { return kTable; }

const RpcRow& RowOf(Rpc rpc) { return kTable[static_cast<std::size_t>(rpc)]; }

bool IsAllowed(Role role, Rpc rpc) {
  const RpcRow& row = RowOf(rpc);
  switch (role) {
    case Role::kRobot:
      return row.robot;
    case Role::kViewer:
      return row.viewer;
    case Role::kOperator:
      return row.op;
    case Role::kAdmin:
      return true;
  }
  return false;
}

}  // namespace plumescout::server
