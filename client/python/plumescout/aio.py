# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The client for asyncio.

    async with plumescout.aio.Client("127.0.0.1:50551") as client:
        robot = await client.register("house", "scout")
        async for house in client.watch_map("house"):
            ...

Its methods are those of plumescout.Client and plumescout.Robot: calls are awaited, streams iterated
over with `async for`.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any, Concatenate, ParamSpec, TypeVar

import grpc
import grpc.aio

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


class _Stream:
    """A call that streams."""

    def __init__(self, channel: grpc.aio.Channel, opened: Open, metadata: Metadata) -> None:
        rpc = opened.rpc
        codec = (rpc.path, rpc.request.SerializeToString, rpc.response.FromString)
        options = dict(timeout=opened.timeout_s, metadata=metadata, wait_for_ready=True)
        self._call: Any
        if not rpc.streams_responses:
            self._call = channel.stream_unary(*codec)(**options)
        elif rpc.streams_requests:
            self._call = channel.stream_stream(*codec)(**options)
        else:
            self._call = channel.unary_stream(*codec)(opened.request, **options)
        self._streams_responses = rpc.streams_responses

    async def write(self, request: Any) -> None:
        """None: no more come. Of a call that has ended, reading says why."""
        try:
            await (self._call.done_writing() if request is None else self._call.write(request))
        except (asyncio.InvalidStateError, grpc.RpcError):
            pass

    async def read(self) -> Any:
        if not self._streams_responses:
            return await self._call
        response = await self._call.read()
        return None if response is grpc.aio.EOF else response

    def cancel(self) -> None:
        self._call.cancel()


class _Driver:
    """Carries out operations on one channel."""

    def __init__(self, target: str, credentials: Credentials) -> None:
        self._credentials = credentials
        self._routes = Routes()
        protection = credentials.channel_credentials()
        if protection is None:
            self.channel = grpc.aio.insecure_channel(target, options=OPTIONS)
        else:
            self.channel = grpc.aio.secure_channel(target, protection, options=OPTIONS)

    async def run(self, operation: Operation[T]) -> T:
        """Of operations that emit nothing."""
        progress = Progress(self._routes.route(operation))
        async for _ in self._carry_out(progress):
            raise AssertionError("an item of an operation that has none")
        return progress.result()

    def iterate(self, operation: Operation[None]) -> AsyncIterator[Any]:
        return self._carry_out(Progress(self._routes.route(operation)))

    async def _carry_out(self, progress: Progress[Any]) -> AsyncIterator[Any]:
        streams: list[_Stream] = []
        try:
            while (effect := progress.advance()) is not None:
                if isinstance(effect, Emit):
                    yield effect.item
                    continue
                try:
                    progress.give(await self._perform(effect, streams))
                except grpc.RpcError as error:
                    progress.fail(error_of(error))
        finally:
            progress.close()
            for stream in streams:
                stream.cancel()

    def _metadata(self, effect: Invoke | Open) -> Metadata:
        return self._credentials.metadata() + effect.metadata

    async def _perform(self, effect: Effect, streams: list[_Stream]) -> Any:
        if isinstance(effect, Invoke):
            rpc = effect.rpc
            call = self.channel.unary_unary(
                rpc.path, rpc.request.SerializeToString, rpc.response.FromString
            )
            return await call(
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
            return await effect.stream.read()
        if isinstance(effect, Write):
            return await effect.stream.write(effect.request)
        if isinstance(effect, EndWriting):
            return await effect.stream.write(None)
        if isinstance(effect, Sleep):
            return await asyncio.sleep(effect.seconds)
        raise AssertionError(effect)


def _client_call(
    method: Callable[Concatenate[Operations, P], Operation[T]]
) -> Callable[Concatenate[Client, P], Awaitable[T]]:
    @presents(method)
    async def call(self: Client, /, *args: P.args, **kwargs: P.kwargs) -> T:
        return await self.driver.run(method(self.operations, *args, **kwargs))

    return call


def _client_stream(
    method: Callable[Concatenate[Operations, P], Operation[None]], item: type[T]
) -> Callable[Concatenate[Client, P], AsyncIterator[T]]:
    @presents(method, f"AsyncIterator[{item.__name__}]")
    def call(self: Client, /, *args: P.args, **kwargs: P.kwargs) -> AsyncIterator[T]:
        return self.driver.iterate(method(self.operations, *args, **kwargs))

    return call


def _robot_call(
    method: Callable[Concatenate[Session, P], Operation[T]]
) -> Callable[Concatenate[Robot, P], Awaitable[T]]:
    @presents(method)
    async def call(self: Robot, /, *args: P.args, **kwargs: P.kwargs) -> T:
        return await self.driver.run(method(self.session, *args, **kwargs))

    return call


def _robot_stream(
    method: Callable[Concatenate[Session, P], Operation[None]], item: type[T]
) -> Callable[Concatenate[Robot, P], AsyncIterator[T]]:
    @presents(method, f"AsyncIterator[{item.__name__}]")
    def call(self: Robot, /, *args: P.args, **kwargs: P.kwargs) -> AsyncIterator[T]:
        return self.driver.iterate(method(self.session, *args, **kwargs))

    return call


def _registration(
    method: Callable[Concatenate[Operations, P], Operation[Session]]
) -> Callable[Concatenate[Client, P], Awaitable[Robot]]:
    @presents(method, "Robot")
    async def call(self: Client, /, *args: P.args, **kwargs: P.kwargs) -> Robot:
        return Robot(self.driver, await self.driver.run(method(self.operations, *args, **kwargs)))

    return call


class Robot(BaseRobot[_Driver]):
    """One robot's part in a mission; made by Client.register. One call at a time, but for
    watch."""

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
    """One connection to a server. Its calls raise PlumeScoutError. For one event loop."""

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

    async def __aenter__(self) -> Client:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        await self.driver.channel.close()

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
