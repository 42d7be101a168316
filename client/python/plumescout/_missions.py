# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What can be asked of a server about itself and its missions, as operations."""

from __future__ import annotations

import pathlib
from collections.abc import Mapping, Sequence
from typing import Any

import grpc
from google.protobuf import json_format

from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import options_pb2 as options_pb
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb
from plumescout.v1 import system_service_pb2 as system_pb

from . import _mission_file, rpcs
from ._calls import Calls
from ._operation import Emit, EndWriting, Open, Operation, Read, Sleep, Write
from .errors import PlumeScoutError

_NO_PROGRESS: _mission_file.Progress = lambda done_bytes, expected_bytes: None
_UNCHANGED: Any = object()
_FIGURES_PERIOD_S = 0.5  # between looks at what a replay has found so far


class MissionOperations(Calls):
    """Names of missions and robots are given without "missions/" and the like."""

    def __init__(self, timeout_s: float) -> None:
        super().__init__(timeout_s)
        self._limits: system_pb.ServerLimits | None = None

    # The server.

    def server_info(self) -> Operation[system_pb.GetServerInfoResponse]:
        """The server's version, limits, features, and who it takes the caller for."""
        return self.call(rpcs.GET_SERVER_INFO, system_pb.GetServerInfoRequest())

    def limits(self) -> Operation[system_pb.ServerLimits]:
        """What one call may ask for, as the server says; of a server that does not say, what any
        takes. Asked for once."""
        if self._limits is None:
            try:
                self._limits = (yield from self.server_info()).limits
            except PlumeScoutError as error:
                if error.code != grpc.StatusCode.UNIMPLEMENTED:
                    raise
                self._limits = system_pb.ServerLimits(
                    max_receive_bytes=256 << 10, max_batch_observation_count=512
                )
        return self._limits

    def drain_server(self) -> Operation[None]:
        """Takes the server out of service; its process ends."""
        yield from self.call(rpcs.DRAIN_SERVER, system_pb.DrainServerRequest())

    # Missions.

    def create_mission(
        self,
        mission: str,
        options: Mapping[str, Any] | options_pb.MissionOptions | None = None,
        exist_ok: bool = False,
        idle_time_to_live_s: float | None = None,
        keep_all_events: bool = True,
    ) -> Operation[mission_pb.Mission]:
        """options: plumescout.v1.MissionOptions, also as nested dict, e.g.
        {"planning": {"speed_mps": 0.5}}; what is left out takes the server's default. A known
        building goes under "prior_map", see prior_map and prior_map_of_files. A mission that nobody
        calls for idle_time_to_live_s is deleted; None: never. Without keep_all_events the server
        keeps those on its disk that a recovery needs: no exports, no look at the past.
        exist_ok: a mission of this name is as good, whatever its options."""
        if not isinstance(options, options_pb.MissionOptions):
            options = json_format.ParseDict(dict(options or {}), options_pb.MissionOptions())
        request = mission_pb.CreateMissionRequest(
            mission_id=mission, options=options, event_retention=_retention(keep_all_events)
        )
        if idle_time_to_live_s is not None:
            request.idle_time_to_live.FromNanoseconds(round(idle_time_to_live_s * 1e9))
        try:
            return (yield from self.call(rpcs.CREATE_MISSION, request)).mission
        except PlumeScoutError as error:
            if not (exist_ok and error.code == grpc.StatusCode.ALREADY_EXISTS):
                raise
        return (yield from self.get_mission(mission))

    def list_missions(self) -> Operation[list[str]]:
        """Their names."""
        missions = yield from self.missions()
        return [mission.name.removeprefix("missions/") for mission in missions]

    def missions(self) -> Operation[list[mission_pb.Mission]]:
        """All missions; their known buildings are left out."""
        pages = yield from self.pages(rpcs.LIST_MISSIONS, mission_pb.ListMissionsRequest())
        return [mission for page in pages for mission in page.missions]

    def get_mission(self, mission: str) -> Operation[mission_pb.Mission]:
        request = mission_pb.GetMissionRequest(name=mission_name(mission))
        return (yield from self.call(rpcs.GET_MISSION, request)).mission

    def pause_mission(self, mission: str) -> Operation[mission_pb.Mission]:
        """No new plans until it is resumed; observations are taken as before."""
        request = mission_pb.PauseMissionRequest(name=mission_name(mission))
        return (yield from self.call(rpcs.PAUSE_MISSION, request)).mission

    def resume_mission(self, mission: str) -> Operation[mission_pb.Mission]:
        request = mission_pb.ResumeMissionRequest(name=mission_name(mission))
        return (yield from self.call(rpcs.RESUME_MISSION, request)).mission

    def finish_mission(self, mission: str) -> Operation[mission_pb.Mission]:
        """Closes a mission for good: its map can be read, nothing changes it any more."""
        request = mission_pb.FinishMissionRequest(name=mission_name(mission))
        return (yield from self.call(rpcs.FINISH_MISSION, request)).mission

    def change_keep_out_areas(
        self,
        mission: str,
        added: Mapping[str, Sequence[tuple[float, float]]] | None = None,
        deleted: Sequence[str] = (),
    ) -> Operation[list[options_pb.Polygon]]:
        """Closes areas to robots and opens them again, all or none: those of the names `deleted`
        go, then `added` come, {name: [(x_m, y_m), ...]} by their corners, in the mission's frame.
        All areas as they are now."""
        request = mission_pb.ChangeKeepOutAreasRequest(name=mission_name(mission), deleted=deleted)
        for name, corners in (added or {}).items():
            area = request.added.add(name=name)
            for x_m, y_m in corners:
                area.vertices.add(x_m=x_m, y_m=y_m)
        return list((yield from self.call(rpcs.CHANGE_KEEP_OUT_AREAS, request)).areas)

    def update_mission(
        self,
        mission: str,
        idle_time_to_live_s: float | None = _UNCHANGED,
        keep_all_events: bool = _UNCHANGED,
    ) -> Operation[mission_pb.Mission]:
        """Changes what is given; see create_mission."""
        request = mission_pb.UpdateMissionRequest()
        request.mission.name = mission_name(mission)
        if idle_time_to_live_s is not _UNCHANGED:
            request.update_mask.paths.append("idle_time_to_live")
            if idle_time_to_live_s is not None:
                idle = request.mission.idle_time_to_live
                idle.FromNanoseconds(round(idle_time_to_live_s * 1e9))
        if keep_all_events is not _UNCHANGED:
            request.update_mask.paths.append("event_retention")
            request.mission.event_retention = _retention(keep_all_events)
        return (yield from self.call(rpcs.UPDATE_MISSION, request)).mission

    def delete_mission(self, mission: str) -> Operation[None]:
        request = mission_pb.DeleteMissionRequest(name=mission_name(mission))
        yield from self.call(rpcs.DELETE_MISSION, request)

    def mission_history(
        self, mission: str, kinds: Sequence[int] = (), first_number: int = 0
    ) -> Operation[None]:
        """What happened, one plumescout.v1.MissionEvent after the other. kinds: values of
        MissionEventKind; none: all."""
        request: Any = snapshot_pb.GetMissionHistoryRequest(
            mission=mission_name(mission), first_number=first_number, page_size=1000
        )
        request.kinds.extend(kinds)
        while True:
            page = yield from self.call(rpcs.GET_MISSION_HISTORY, request)
            for event in page.events:
                yield Emit(event)
            request.page_token = page.next_page_token
            if not request.page_token:
                return

    def mission_figures(self, mission: str) -> Operation[list[snapshot_pb.MissionFigures]]:
        """How the map came to have its figures: some hundred plumescout.v1.MissionFigures, in order
        of their revisions. The server replays the journal for that, which is waited for."""
        request = snapshot_pb.GetMissionFiguresRequest(mission=mission_name(mission))
        while True:
            response = yield from self.call(rpcs.GET_MISSION_FIGURES, request)
            if not response.more_follow:
                return list(response.figures)
            yield Sleep(_FIGURES_PERIOD_S)

    def export_mission(
        self,
        mission: str,
        path: str | pathlib.Path,
        progress: _mission_file.Progress = _NO_PROGRESS,
        mcap: bool = False,
    ) -> Operation[snapshot_pb.MissionFileStart]:
        """Writes a mission to a file: all its events so far. The file is there once it is whole.

        progress: called now and then with how many bytes have come, and how many will, about.
        mcap: an MCAP file, which Foxglove shows, instead of a journal, which import_mission takes.
        """
        request = snapshot_pb.ExportMissionRequest(
            mission=mission_name(mission),
            format=snapshot_pb.MISSION_FILE_FORMAT_MCAP
            if mcap
            else snapshot_pb.MISSION_FILE_FORMAT_JOURNAL,
        )
        stream = yield Open(rpcs.EXPORT_MISSION, request)
        try:
            with _mission_file.Writer(path, progress) as writer:
                while (response := (yield Read(stream))) is not None:
                    writer.take(response)
                return writer.finish()
        except _mission_file.DamagedExport as error:
            raise PlumeScoutError(grpc.StatusCode.DATA_LOSS, str(error)) from None

    def import_mission(
        self,
        path: str | pathlib.Path,
        mission: str | None = None,
        progress: _mission_file.Progress = _NO_PROGRESS,
    ) -> Operation[mission_pb.Mission]:
        """Makes a mission of an exported one, under this name or else that in the file. Returns it
        once it is durable and its events were applied, which may take as long as they took the
        server that it comes from. progress: as of export_mission."""
        limits = yield from self.limits()
        with open(path, "rb") as file:
            stream = yield Open(rpcs.IMPORT_MISSION)
            parts = _mission_file.requests(file, mission, limits.max_receive_bytes, progress)
            for part in parts:
                yield Write(stream, part)
            yield EndWriting(stream)
            response: snapshot_pb.ImportMissionResponse = yield Read(stream)
            return response.mission


def mission_name(mission: str) -> str:
    return f"missions/{mission}"


def _retention(keep_all: bool) -> mission_pb.EventRetention:
    if keep_all:
        return mission_pb.EVENT_RETENTION_ALL
    return mission_pb.EVENT_RETENTION_SINCE_SNAPSHOT
