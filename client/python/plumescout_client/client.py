# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A connection to a server."""

import secrets
import time

import grpc
import numpy as np
from google.protobuf import json_format

from plumescout.v1 import ingest_service_pb2_grpc as ingest_grpc
from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import map_service_pb2_grpc as map_grpc
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc
from plumescout.v1 import options_pb2 as options_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import planning_service_pb2_grpc as planning_grpc
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import robot_service_pb2_grpc as robot_grpc
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb
from plumescout.v1 import snapshot_service_pb2_grpc as snapshot_grpc
from plumescout.v1 import system_service_pb2 as system_pb
from plumescout.v1 import system_service_pb2_grpc as system_grpc

from . import mission_file
from .calls import Calls
from .errors import PlumeScoutError, error_of
from .robot import Robot
from .values import _map_from_proto, _points

_MAP_ATTEMPTS = 5
_LOG_EPOCH_END = 1 << 53


def _retention(keep_all):
    if keep_all:
        return mission_pb.EVENT_RETENTION_ALL
    return mission_pb.EVENT_RETENTION_SINCE_SNAPSHOT


class Client(Calls):
    """One connection to a server. Its calls raise PlumeScoutError."""

    def __init__(self, target="127.0.0.1:50551", timeout_s=10.0, **credentials):
        """credentials: tls_ca, tls_cert, tls_key, token_file; see plumescout_channel."""
        super().__init__(target, timeout_s, credentials)
        self._limits = None  # asked for when they are needed
        self._missions = mission_grpc.MissionServiceStub(self._channel)
        self._robots = robot_grpc.RobotServiceStub(self._channel)
        self._ingest = ingest_grpc.IngestServiceStub(self._channel)
        self._planning = planning_grpc.PlanningServiceStub(self._channel)
        self._maps = map_grpc.MapServiceStub(self._channel)
        self._snapshots = snapshot_grpc.SnapshotServiceStub(self._channel)
        self._system = system_grpc.SystemServiceStub(self._channel)

    @property
    def limits(self):
        """What one call may ask for (plumescout.v1.ServerLimits), as the server says; of a server
        that does not say, what any takes."""
        if self._limits is None:
            try:
                self._limits = self.server_info().limits
            except PlumeScoutError as error:
                if error.code != grpc.StatusCode.UNIMPLEMENTED:
                    raise
                self._limits = system_pb.ServerLimits(
                    max_receive_bytes=256 << 10, max_batch_observation_count=512
                )
        return self._limits

    def server_info(self):
        """The server's version, limits, features, and who it takes the caller for."""
        return self._call(self._system.GetServerInfo, system_pb.GetServerInfoRequest())

    def drain_server(self):
        """Takes the server out of service; its process ends."""
        self._call(self._system.DrainServer, system_pb.DrainServerRequest())

    def create_mission(
        self,
        mission,
        options=None,
        exist_ok=False,
        idle_time_to_live_s=None,
        keep_all_events=True,
    ):
        """options: nested dict of plumescout.v1.MissionOptions, e.g.
        {"planning": {"speed_mps": 0.5}}; what is left out takes the server's default. A known
        building goes under "prior_map", see prior_map and prior_map_of_files. A mission that nobody
        calls for idle_time_to_live_s is deleted; None: never. Without keep_all_events the server
        keeps those on its disk that a recovery needs: no exports, no look at the past."""
        request = mission_pb.CreateMissionRequest(
            mission_id=mission,
            options=json_format.ParseDict(options or {}, options_pb.MissionOptions()),
        )
        if idle_time_to_live_s is not None:
            request.idle_time_to_live.FromNanoseconds(round(idle_time_to_live_s * 1e9))
        if not keep_all_events:
            request.event_retention = _retention(keep_all_events)
        try:
            self._call_named(self._missions.CreateMission, request)
        except PlumeScoutError as error:
            if not (exist_ok and error.code == grpc.StatusCode.ALREADY_EXISTS):
                raise

    def list_missions(self):
        return [mission.name.removeprefix("missions/") for mission in self.missions()]

    def missions(self):
        """All missions, as plumescout.v1.Mission; their known buildings are left out."""
        return self._pages(self._missions.ListMissions, mission_pb.ListMissionsRequest(), "missions")

    def get_mission(self, mission):
        request = mission_pb.GetMissionRequest(name=f"missions/{mission}")
        return self._call(self._missions.GetMission, request).mission

    def pause_mission(self, mission):
        """No new plans until it is resumed; observations are taken as before."""
        request = mission_pb.PauseMissionRequest(name=f"missions/{mission}")
        return self._call(self._missions.PauseMission, request).mission

    def resume_mission(self, mission):
        request = mission_pb.ResumeMissionRequest(name=f"missions/{mission}")
        return self._call(self._missions.ResumeMission, request).mission

    def finish_mission(self, mission):
        """Closes a mission for good: its map can be read, nothing changes it any more."""
        request = mission_pb.FinishMissionRequest(name=f"missions/{mission}")
        return self._call(self._missions.FinishMission, request).mission

    def set_idle_time_to_live(self, mission, seconds):
        """A mission that nobody calls for so long is deleted; None: never."""
        request = mission_pb.UpdateMissionRequest(
            mission=mission_pb.Mission(name=f"missions/{mission}"),
            update_mask={"paths": ["idle_time_to_live"]},
        )
        if seconds is not None:
            request.mission.idle_time_to_live.FromNanoseconds(round(seconds * 1e9))
        return self._call(self._missions.UpdateMission, request).mission

    def set_keep_all_events(self, mission, keep_all):
        """Whether all of a mission's events stay on the server's disk, or those that a recovery
        needs; the others go with its next snapshots."""
        request = mission_pb.UpdateMissionRequest(
            mission=mission_pb.Mission(
                name=f"missions/{mission}", event_retention=_retention(keep_all)
            ),
            update_mask={"paths": ["event_retention"]},
        )
        return self._call(self._missions.UpdateMission, request).mission

    def delete_mission(self, mission):
        request = mission_pb.DeleteMissionRequest(name=f"missions/{mission}")
        self._call(self._missions.DeleteMission, request)

    def register(
        self,
        mission,
        robot,
        radius_m=0.2,
        take_over=False,
        on_rejected=None,
        frame=None,
        frame_stddev=(0.0, 0.0),
        clock_ns=time.time_ns,
        gas_sensors=(),
    ):
        """Joins a mission, or comes back to it; returns a Robot.

        frame: (x_m, y_m, yaw_rad) of the origin of the robot's own frame in the mission's, for its
        observations are in that, and standard deviations in metres and radians. Starts and plans
        are in the mission's frame.

        gas_sensors: plumescout.v1.GasSensor of each sensor, to which readings refer by their place;
        none: one, calibrated, at the robot's pose.

        clock_ns tells the robot's time now, by the clock that its samples have their times of: the
        server learns from it how far that clock is off. None: it is taken as it is, as of
        simulations that do not keep real time.

        on_rejected is called with the Rejection of each observation that the server refuses, from
        within the call that sent it; default: a warning of the logger "plumescout_client"."""
        request = robot_pb.RegisterRobotRequest(
            mission=f"missions/{mission}",
            robot_id=robot,
            radius_m=radius_m,
            take_over=take_over,
            log_epoch=1 + secrets.randbelow(_LOG_EPOCH_END - 1),
            gas_sensors=gas_sensors,
        )
        if frame is not None:
            x_m, y_m, yaw_rad = frame
            origin = request.frame.mission_from_robot
            origin.x_m, origin.y_m, origin.yaw_rad = x_m, y_m, yaw_rad
            request.frame.position_stddev_m, request.frame.heading_stddev_rad = frame_stddev
        registration = self._call_named(self._robots.RegisterRobot, request)
        return Robot(self, registration, on_rejected, clock_ns)

    def robots(self, mission):
        """The robots of a mission, as plumescout.v1.Robot."""
        request = robot_pb.ListRobotsRequest(mission=f"missions/{mission}")
        return self._pages(self._robots.ListRobots, request, "robots")

    def get_robot(self, mission, robot):
        request = robot_pb.GetRobotRequest(name=f"missions/{mission}/robots/{robot}")
        return self._call(self._robots.GetRobot, request).robot

    def watch_robot(self, mission, robot):
        """Yields what there is to tell of a robot, as plumescout.v1.WatchRobotResponse, whoever holds
        its lease; see Robot.watch."""
        return self._watch(f"missions/{mission}/robots/{robot}", lease_token=0)

    def _watch(self, robot, lease_token):
        request = robot_pb.WatchRobotRequest(robot=robot, lease_token=lease_token)
        responses = self._robots.WatchRobot(request)
        try:
            yield from responses
        except grpc.RpcError as error:
            raise error_of(error) from None
        finally:
            responses.cancel()

    def release_lease(self, mission, robot):
        """Frees a robot's lease whoever holds it, as of a client that died; see Robot.release."""
        request = robot_pb.ReleaseLeaseRequest(
            robot=f"missions/{mission}/robots/{robot}", force=True
        )
        self._call(self._robots.ReleaseLease, request)

    def order_home(self, mission, robot=None, home=True):
        """Sends a robot home, or all of the mission; home=False: they need not go any more."""
        if robot is None:
            request = robot_pb.OrderHomeRequest(mission=f"missions/{mission}", home=home)
        else:
            name = f"missions/{mission}/robots/{robot}"
            request = robot_pb.OrderHomeRequest(robot=name, home=home)
        self._call_named(self._robots.OrderHome, request)

    def live_plans(self, mission):
        """Where its robots are on their way to, as plumescout.v1.LivePlan."""
        request = planning_pb.ListPlansRequest(mission=f"missions/{mission}")
        return list(self._call(self._planning.ListPlans, request).plans)

    def plan_team(self, mission, robots=(), go_home=False, budget_s=None, max_orders=0, seed=0):
        """Plans for several robots at once, by default for all that are free, which then fetch
        them with next_best_trajectory; returns a plumescout.v1.PlanTeamResponse."""
        request = planning_pb.PlanTeamRequest(
            mission=f"missions/{mission}",
            robots=[f"missions/{mission}/robots/{robot}" for robot in robots],
            go_home=go_home,
            max_order_count=max_orders,
            seed=seed,
        )
        if budget_s is not None:
            request.planning_budget.FromNanoseconds(round(budget_s * 1e9))
        return self._call_named(self._planning.PlanTeam, request)

    def remove_robot(self, mission, robot):
        """Removes a robot whoever holds its lease, as one that died; see Robot.leave."""
        request = robot_pb.RemoveRobotRequest(
            robot=f"missions/{mission}/robots/{robot}", force=True
        )
        self._call(self._robots.RemoveRobot, request)

    def export_mission(self, mission, path, progress=lambda done, expected: None, mcap=False):
        """Writes a mission to a file: all its events so far. The file is there once it is whole.
        Returns a plumescout.v1.MissionFileStart.

        progress: called now and then with how many bytes have come, and how many will, about.
        mcap: an MCAP file, which Foxglove shows, instead of a journal, which import_mission takes.
        """
        request = snapshot_pb.ExportMissionRequest(
            mission=f"missions/{mission}",
            format=snapshot_pb.MISSION_FILE_FORMAT_MCAP
            if mcap
            else snapshot_pb.MISSION_FILE_FORMAT_JOURNAL,
        )
        try:
            responses = self._snapshots.ExportMission(request, wait_for_ready=True)
            return mission_file.write(responses, path, progress)
        except grpc.RpcError as error:
            raise error_of(error) from None
        except mission_file.DamagedExport as error:
            raise PlumeScoutError(grpc.StatusCode.DATA_LOSS, str(error)) from None

    def import_mission(self, path, mission=None, progress=lambda done, expected: None):
        """Makes a mission of an exported one, under this name or else that in the file. Returns it
        once it is durable and its events were applied, which may take as long as they took the server
        that it comes from. progress: as of export_mission."""
        with open(path, "rb") as file:
            parts = mission_file.requests(file, mission, self.limits.max_receive_bytes, progress)
            try:
                return self._snapshots.ImportMission(parts, wait_for_ready=True).mission
            except grpc.RpcError as error:
                raise error_of(error) from None

    def mission_history(self, mission, kinds=(), first_number=0):
        """What happened, as plumescout.v1.MissionEvent, one after the other. kinds: values of
        MissionEventKind; none: all."""
        request = snapshot_pb.GetMissionHistoryRequest(
            mission=f"missions/{mission}", kinds=kinds, first_number=first_number, page_size=1000
        )
        while True:
            response = self._call(self._snapshots.GetMissionHistory, request)
            yield from response.events
            request.page_token = response.next_page_token
            if not request.page_token:
                return

    def get_map(self, mission, region=None, level_of_detail=0, revision=0, species=None):
        """The map of a mission, as it is, or as it was at a revision.

        region: (min_x_m, min_y_m, max_x_m, max_y_m); what its tiles do not cover stays UNKNOWN and
        NaN. level_of_detail: squares of 2**n by 2**n cells make one, n up to 6: the worst of their
        states, their largest values. species: which of the mission's gases, by name; default: the
        first."""
        request = map_pb.GetMapRequest(
            mission=f"missions/{mission}",
            full_precision=True,
            fresh_posterior=True,
            level_of_detail=level_of_detail,
            revision=revision,
            species=[species] if species else [],
        )
        if region is not None:
            corners = _points([region[:2], region[2:]])
            request.region.CopyFrom(map_pb.MapRegion(min=corners[0], max=corners[1]))
        for attempt in range(_MAP_ATTEMPTS):
            request.part_token = ""
            try:
                parts = [self._call(self._maps.GetMap, request)]
                while parts[-1].next_part_token:
                    request.part_token = parts[-1].next_part_token
                    parts.append(self._call(self._maps.GetMap, request))
                return _map_from_proto(parts)
            except PlumeScoutError as error:  # the map has changed too much between its parts
                if error.code != grpc.StatusCode.ABORTED or attempt == _MAP_ATTEMPTS - 1:
                    raise

    def query_gas(self, mission, points, species=None):
        """What the gas field says at points, an array of shape (n, 2): x_m, y_m. species: as of
        get_map.

        Returns mean (ppm) and variance (ppm^2), each of shape (n,), NaN off free cells."""
        request = map_pb.QueryGasRequest(
            mission=f"missions/{mission}",
            points=_points(points),
            fresh_posterior=True,
            species=species or "",
        )
        gas = self._call(self._maps.QueryGas, request).gas
        mean_ppm = [g.mean_ppm if g.HasField("mean_ppm") else np.nan for g in gas]
        variance_ppm2 = [g.variance_ppm2 if g.HasField("variance_ppm2") else np.nan for g in gas]
        return np.array(mean_ppm), np.array(variance_ppm2)
