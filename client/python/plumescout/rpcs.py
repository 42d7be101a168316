# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The RPCs of the server. Those that Client has no method for can be called by `Client.call`."""

from __future__ import annotations

import dataclasses
from typing import Generic, TypeVar

from google.protobuf.message import Message

from plumescout.v1 import ingest_service_pb2 as ingest
from plumescout.v1 import map_service_pb2 as maps
from plumescout.v1 import mission_service_pb2 as missions
from plumescout.v1 import planning_service_pb2 as planning
from plumescout.v1 import robot_service_pb2 as robots
from plumescout.v1 import snapshot_service_pb2 as snapshots
from plumescout.v1 import system_service_pb2 as system

Request = TypeVar("Request", bound=Message)
Response = TypeVar("Response", bound=Message)


@dataclasses.dataclass(frozen=True)
class Rpc(Generic[Request, Response]):
    """One RPC."""

    service: str
    request: type[Request]
    response: type[Response]
    streams_requests: bool = False
    streams_responses: bool = False
    repeatable: bool = True
    """Made twice it does what it does once; those with a request_id are."""

    @property
    def path(self) -> str:
        name = self.request.__name__.removesuffix("Request")
        return f"/plumescout.v1.{self.service}/{name}"


GET_SERVER_INFO = Rpc("SystemService", system.GetServerInfoRequest, system.GetServerInfoResponse)
DRAIN_SERVER = Rpc(
    "SystemService", system.DrainServerRequest, system.DrainServerResponse, repeatable=False
)

_MISSIONS = "MissionService"
CREATE_MISSION = Rpc(_MISSIONS, missions.CreateMissionRequest, missions.CreateMissionResponse)
GET_MISSION = Rpc(_MISSIONS, missions.GetMissionRequest, missions.GetMissionResponse)
LIST_MISSIONS = Rpc(_MISSIONS, missions.ListMissionsRequest, missions.ListMissionsResponse)
DELETE_MISSION = Rpc(
    _MISSIONS, missions.DeleteMissionRequest, missions.DeleteMissionResponse, repeatable=False
)
UPDATE_MISSION = Rpc(
    _MISSIONS, missions.UpdateMissionRequest, missions.UpdateMissionResponse, repeatable=False
)
PAUSE_MISSION = Rpc(
    _MISSIONS, missions.PauseMissionRequest, missions.PauseMissionResponse, repeatable=False
)
RESUME_MISSION = Rpc(
    _MISSIONS, missions.ResumeMissionRequest, missions.ResumeMissionResponse, repeatable=False
)
FINISH_MISSION = Rpc(
    _MISSIONS, missions.FinishMissionRequest, missions.FinishMissionResponse, repeatable=False
)
CHANGE_KEEP_OUT_AREAS = Rpc(
    _MISSIONS, missions.ChangeKeepOutAreasRequest, missions.ChangeKeepOutAreasResponse
)

_ROBOTS = "RobotService"
REGISTER_ROBOT = Rpc(_ROBOTS, robots.RegisterRobotRequest, robots.RegisterRobotResponse)
REMOVE_ROBOT = Rpc(_ROBOTS, robots.RemoveRobotRequest, robots.RemoveRobotResponse, repeatable=False)
GET_ROBOT = Rpc(_ROBOTS, robots.GetRobotRequest, robots.GetRobotResponse)
LIST_ROBOTS = Rpc(_ROBOTS, robots.ListRobotsRequest, robots.ListRobotsResponse)
RELEASE_LEASE = Rpc(
    _ROBOTS, robots.ReleaseLeaseRequest, robots.ReleaseLeaseResponse, repeatable=False
)
ORDER_HOME = Rpc(_ROBOTS, robots.OrderHomeRequest, robots.OrderHomeResponse)
WATCH_ROBOT = Rpc(
    _ROBOTS, robots.WatchRobotRequest, robots.WatchRobotResponse, streams_responses=True
)

_INGEST = "IngestService"
STREAM_OBSERVATIONS = Rpc(
    _INGEST,
    ingest.StreamObservationsRequest,
    ingest.StreamObservationsResponse,
    streams_requests=True,
    streams_responses=True,
)
BATCH_INGEST_OBSERVATIONS = Rpc(
    _INGEST, ingest.BatchIngestObservationsRequest, ingest.BatchIngestObservationsResponse
)

_PLANNING = "PlanningService"
NEXT_BEST_TRAJECTORY = Rpc(
    _PLANNING, planning.NextBestTrajectoryRequest, planning.NextBestTrajectoryResponse
)
STREAM_NEXT_BEST_TRAJECTORY = Rpc(
    _PLANNING,
    planning.StreamNextBestTrajectoryRequest,
    planning.StreamNextBestTrajectoryResponse,
    streams_responses=True,
)
CHECK_TRAJECTORY = Rpc(_PLANNING, planning.CheckTrajectoryRequest, planning.CheckTrajectoryResponse)
LIST_FRONTIERS = Rpc(_PLANNING, planning.ListFrontiersRequest, planning.ListFrontiersResponse)
REPORT_PROGRESS = Rpc(_PLANNING, planning.ReportProgressRequest, planning.ReportProgressResponse)
LIST_PLANS = Rpc(_PLANNING, planning.ListPlansRequest, planning.ListPlansResponse)
PLAN_TEAM = Rpc(_PLANNING, planning.PlanTeamRequest, planning.PlanTeamResponse)

GET_MAP = Rpc("MapService", maps.GetMapRequest, maps.GetMapResponse)
QUERY_GAS = Rpc("MapService", maps.QueryGasRequest, maps.QueryGasResponse)
WATCH_MAP = Rpc("MapService", maps.WatchMapRequest, maps.WatchMapResponse, streams_responses=True)

_SNAPSHOTS = "SnapshotService"
EXPORT_MISSION = Rpc(
    _SNAPSHOTS,
    snapshots.ExportMissionRequest,
    snapshots.ExportMissionResponse,
    streams_responses=True,
)
IMPORT_MISSION = Rpc(
    _SNAPSHOTS,
    snapshots.ImportMissionRequest,
    snapshots.ImportMissionResponse,
    streams_requests=True,
    repeatable=False,
)
GET_MISSION_HISTORY = Rpc(
    _SNAPSHOTS, snapshots.GetMissionHistoryRequest, snapshots.GetMissionHistoryResponse
)
GET_MISSION_FIGURES = Rpc(
    _SNAPSHOTS, snapshots.GetMissionFiguresRequest, snapshots.GetMissionFiguresResponse
)

ALL = [value for value in list(globals().values()) if isinstance(value, Rpc)]
