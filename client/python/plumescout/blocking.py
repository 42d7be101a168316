# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The client whose calls wait for their answers."""

from __future__ import annotations

import contextlib
import queue
import time
from collections.abc import Callable, Iterator
from typing import Any, Concatenate, ParamSpec, TypeVar

import grpc

from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb

from ._client import Operations
from ._facade import (
    DEFAULT_TARGET,
    DEFAULT_TIMEOUT_S,
    OPTIONS,
    BaseRobot,
    Credentials,
    Metadata,
    StrPath,
    presents,
)
from ._operation import (
    Effect,
    Emit,
    EndWriting,
    Invoke,
    Open,
    Operation,
    Progress,
    Read,
    Sleep,
    Write,
)
from ._routes import Routes
from ._session import Session
from .errors import error_of
from .maps import Map
from .plans import Plan

P = ParamSpec("P")
T = TypeVar("T")
_QUEUED_REQUESTS = 4
_LOOK_PERIOD_S = 0.1  # how often it is seen that a call has ended that takes no requests any more


class _Stream:
    """A call that streams."""

    def __init__(self, channel: grpc.Channel, opened: Open, metadata: Metadata) -> None:
        self._requests: queue.Queue[Any] = queue.Queue(_QUEUED_REQUESTS)
        rpc = opened.rpc
        codec = (rpc.path, rpc.request.SerializeToString, rpc.response.FromString)
        options = dict(timeout=opened.timeout_s, metadata=metadata, wait_for_ready=True)
        requests: Iterator[Any] = iter(self._requests.get, None)
        self._call: Any
        if not rpc.streams_responses:
            self._call = channel.stream_unary(*codec).future(requests, **options)
        elif rpc.streams_requests:
            self._call = channel.stream_stream(*codec)(requests, **options)
        else:
            self._call = channel.unary_stream(*codec)(opened.request, **options)
        self._streams_responses = rpc.streams_responses

    def write(self, request: Any) -> None:
        """None: no more come."""
        while self._call.is_active():
            try:
                return self._requests.put(request, timeout=_LOOK_PERIOD_S)
            except queue.Full:
                continue

    def read(self) -> Any:
        return next(self._call, None) if self._streams_responses else self._call.result()

    def cancel(self) -> None:
        self._call.cancel()
        with contextlib.suppress(queue.Empty):  # who feeds the call waits for the end of them
            while True:
                self._requests.get_nowait()
        self._requests.put(None)


class _Driver:
    """Carries out operations on one channel."""

    def __init__(self, target: str, credentials: Credentials) -> None:
        self._credentials = credentials
        self._routes = Routes()
        protection = credentials.channel_credentials()
        if protection is None:
            self.channel = grpc.insecure_channel(target, options=OPTIONS)
        else:
            self.channel = grpc.secure_channel(target, protection, options=OPTIONS)

    def run(self, operation: Operation[T]) -> T:
        """Of operations that emit nothing."""
        progress = Progress(self._routes.route(operation))
        for _ in self._carry_out(progress):
            raise AssertionError("an item of an operation that has none")
        return progress.result()

    def iterate(self, operation: Operation[None]) -> Iterator[Any]:
        return self._carry_out(Progress(self._routes.route(operation)))

    def _carry_out(self, progress: Progress[Any]) -> Iterator[Any]:
        streams: list[_Stream] = []
        try:
            while (effect := progress.advance()) is not None:
                if isinstance(effect, Emit):
                    yield effect.item
                    continue
                try:
                    progress.give(self._perform(effect, streams))
                except grpc.RpcError as error:
                    progress.fail(error_of(error))
        finally:
            progress.close()
            for stream in streams:
                stream.cancel()

    def _metadata(self, effect: Invoke | Open) -> Metadata:
        return self._credentials.metadata() + effect.metadata

    def _perform(self, effect: Effect, streams: list[_Stream]) -> Any:
        if isinstance(effect, Invoke):
            rpc = effect.rpc
            call = self.channel.unary_unary(
                rpc.path, rpc.request.SerializeToString, rpc.response.FromString
            )
            return call(
                effect.request,
                timeout=effect.timeout_s,
                metadata=self._metadata(effect),
                wait_for_ready=True,
            )
        if isinstance(effect, Open):
            while streams:  # an operation has one at a time
                streams.pop().cancel()
            streams.append(_Stream(self.channel, effect, self._metadata(effect)))
            return streams[-1]
        if isinstance(effect, Read):
            return effect.stream.read()
        if isinstance(effect, Write):
            return effect.stream.write(effect.request)
        if isinstance(effect, EndWriting):
            return effect.stream.write(None)
        if isinstance(effect, Sleep):
            return time.sleep(effect.seconds)
        raise AssertionError(effect)


def _client_call(
    method: Callable[Concatenate[Operations, P], Operation[T]]
) -> Callable[Concatenate[Client, P], T]:
    @presents(method)
    def call(self: Client, /, *args: P.args, **kwargs: P.kwargs) -> T:
        return self.driver.run(method(self.operations, *args, **kwargs))

    return call


def _client_stream(
    method: Callable[Concatenate[Operations, P], Operation[None]], item: type[T]
) -> Callable[Concatenate[Client, P], Iterator[T]]:
    @presents(method, f"Iterator[{item.__name__}]")
    def call(self: Client, /, *args: P.args, **kwargs: P.kwargs) -> Iterator[T]:
        return self.driver.iterate(method(self.operations, *args, **kwargs))

    return call


def _robot_call(
    method: Callable[Concatenate[Session, P], Operation[T]]
) -> Callable[Concatenate[Robot, P], T]:
    @presents(method)
    def call(self: Robot, /, *args: P.args, **kwargs: P.kwargs) -> T:
        return self.driver.run(method(self.session, *args, **kwargs))

    return call


def _robot_stream(
    method: Callable[Concatenate[Session, P], Operation[None]], item: type[T]
) -> Callable[Concatenate[Robot, P], Iterator[T]]:
    @presents(method, f"Iterator[{item.__name__}]")
    def call(self: Robot, /, *args: P.args, **kwargs: P.kwargs) -> Iterator[T]:
        return self.driver.iterate(method(self.session, *args, **kwargs))

    return call


def _registration(
    method: Callable[Concatenate[Operations, P], Operation[Session]]
) -> Callable[Concatenate[Client, P], Robot]:
    @presents(method, "Robot")
    def call(self: Client, /, *args: P.args, **kwargs: P.kwargs) -> Robot:
        return Robot(self.driver, self.driver.run(method(self.operations, *args, **kwargs)))

    return call


class Robot(BaseRobot[_Driver]):
    """One robot's part in a mission; made by Client.register. add_... may be called on any thread,
    also while another waits in a call; one call at a time, but for watch."""

    flush = _robot_call(Session.flush)
    next_best_trajectory = _robot_call(Session.next_best_trajectory)
    stream_trajectories = _robot_stream(Session.stream_trajectories, Plan)
    check = _robot_call(Session.check)
    check_path = _robot_call(Session.check_path)
    list_frontiers = _robot_call(Session.list_frontiers)
    report = _robot_call(Session.report)
    watch = _robot_stream(Session.watch, robot_pb.WatchRobotResponse)
    release = _robot_call(Session.release)
    leave = _robot_call(Session.leave)


class Client:
    """One connection to a server. Its calls raise PlumeScoutError. Thread-safe."""

    def __init__(
        self,
        target: str = DEFAULT_TARGET,
        timeout_s: float = DEFAULT_TIMEOUT_S,
        tls_ca: StrPath | None = None,
        tls_cert: StrPath | None = None,
        tls_key: StrPath | None = None,
        token_file: StrPath | None = None,
    ) -> None:
        """target: HOST:PORT. timeout_s: of a call, waiting for the server included. The rest says
        how the connection is protected; default: environment variables PLUMESCOUT_TLS_CA and so on,
        or else plaintext."""
        self.driver = _Driver(target, Credentials(tls_ca, tls_cert, tls_key, token_file))
        self.operations = Operations(timeout_s)

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        self.driver.channel.close()

    call = _client_call(Operations.call)
    server_info = _client_call(Operations.server_info)
    limits = _client_call(Operations.limits)
    drain_server = _client_call(Operations.drain_server)
    create_mission = _client_call(Operations.create_mission)
    list_missions = _client_call(Operations.list_missions)
    missions = _client_call(Operations.missions)
    get_mission = _client_call(Operations.get_mission)
    pause_mission = _client_call(Operations.pause_mission)
    resume_mission = _client_call(Operations.resume_mission)
    finish_mission = _client_call(Operations.finish_mission)
    change_keep_out_areas = _client_call(Operations.change_keep_out_areas)
    update_mission = _client_call(Operations.update_mission)
    delete_mission = _client_call(Operations.delete_mission)
    mission_history = _client_stream(Operations.mission_history, snapshot_pb.MissionEvent)
    mission_figures = _client_call(Operations.mission_figures)
    export_mission = _client_call(Operations.export_mission)
    import_mission = _client_call(Operations.import_mission)
    register = _registration(Operations.register)
    robots = _client_call(Operations.robots)
    get_robot = _client_call(Operations.get_robot)
    watch_robot = _client_stream(Operations.watch_robot, robot_pb.WatchRobotResponse)
    release_lease = _client_call(Operations.release_lease)
    remove_robot = _client_call(Operations.remove_robot)
    order_home = _client_call(Operations.order_home)
    live_plans = _client_call(Operations.live_plans)
    plan_team = _client_call(Operations.plan_team)
    get_map = _client_call(Operations.get_map)
    watch_map = _client_stream(Operations.watch_map, Map)
    query_gas = _client_call(Operations.query_gas)
    nearest_readings = _client_call(Operations.nearest_readings)
