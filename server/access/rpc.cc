// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/rpc.h"

#include <cstddef>

namespace plumescout::server {
namespace {

constexpr bool kYes = true;
constexpr bool kNo = false;

constexpr std::array<RpcRow, kRpcCount> kTable = {{
    // rpc, service, method, robot viewer operator costly
    {Rpc::kCreateMission, "MissionService", "CreateMission", kNo, kNo, kYes, kYes},
    {Rpc::kGetMission, "MissionService", "GetMission", kYes, kYes, kYes, kNo},
    {Rpc::kListMissions, "MissionService", "ListMissions", kYes, kYes, kYes, kNo},
    {Rpc::kDeleteMission, "MissionService", "DeleteMission", kNo, kNo, kYes, kNo},
    {Rpc::kUpdateMission, "MissionService", "UpdateMission", kNo, kNo, kYes, kNo},
    {Rpc::kPauseMission, "MissionService", "PauseMission", kNo, kNo, kYes, kNo},
    {Rpc::kResumeMission, "MissionService", "ResumeMission", kNo, kNo, kYes, kNo},
    {Rpc::kFinishMission, "MissionService", "FinishMission", kNo, kNo, kYes, kNo},
    {Rpc::kChangeKeepOutAreas, "MissionService", "ChangeKeepOutAreas", kNo, kNo, kYes, kNo},
    {Rpc::kRegisterRobot, "RobotService", "RegisterRobot", kYes, kNo, kYes, kNo},
    {Rpc::kRemoveRobot, "RobotService", "RemoveRobot", kYes, kNo, kYes, kNo},
    {Rpc::kGetRobot, "RobotService", "GetRobot", kYes, kYes, kYes, kNo},
    {Rpc::kListRobots, "RobotService", "ListRobots", kYes, kYes, kYes, kNo},
    {Rpc::kReleaseLease, "RobotService", "ReleaseLease", kYes, kNo, kYes, kNo},
    {Rpc::kOrderHome, "RobotService", "OrderHome", kNo, kNo, kYes, kNo},
    {Rpc::kWatchRobot, "RobotService", "WatchRobot", kYes, kNo, kYes, kNo},
    {Rpc::kStreamObservations, "IngestService", "StreamObservations", kYes, kNo, kYes, kNo},
    {Rpc::kBatchIngestObservations, "IngestService", "BatchIngestObservations", kYes, kNo, kYes,
     kNo},
    {Rpc::kNextBestTrajectory, "PlanningService", "NextBestTrajectory", kYes, kNo, kYes, kNo},
    {Rpc::kStreamNextBestTrajectory, "PlanningService", "StreamNextBestTrajectory", kYes, kNo, kYes,
     kNo},
    {Rpc::kCheckTrajectory, "PlanningService", "CheckTrajectory", kYes, kNo, kYes, kNo},
    {Rpc::kListFrontiers, "PlanningService", "ListFrontiers", kYes, kYes, kYes, kYes},
    {Rpc::kReportProgress, "PlanningService", "ReportProgress", kYes, kNo, kYes, kNo},
    {Rpc::kListPlans, "PlanningService", "ListPlans", kYes, kYes, kYes, kNo},
    {Rpc::kPlanTeam, "PlanningService", "PlanTeam", kNo, kNo, kYes, kYes},
    {Rpc::kGetMap, "MapService", "GetMap", kYes, kYes, kYes, kYes},
    {Rpc::kQueryGas, "MapService", "QueryGas", kYes, kYes, kYes, kYes},
    {Rpc::kWatchMap, "MapService", "WatchMap", kYes, kYes, kYes, kYes},
    {Rpc::kExportMission, "SnapshotService", "ExportMission", kNo, kNo, kYes, kYes},
    {Rpc::kImportMission, "SnapshotService", "ImportMission", kNo, kNo, kYes, kYes},
    {Rpc::kGetMissionHistory, "SnapshotService", "GetMissionHistory", kNo, kYes, kYes, kYes},
    {Rpc::kGetMissionFigures, "SnapshotService", "GetMissionFigures", kNo, kYes, kYes, kYes},
    {Rpc::kGetServerInfo, "SystemService", "GetServerInfo", kYes, kYes, kYes, kNo},
    {Rpc::kDrainServer, "SystemService", "DrainServer", kNo, kNo, kNo, kNo},
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
