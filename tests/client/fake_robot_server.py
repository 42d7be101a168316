# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A server of one robot that lives in the test: it carries out what operations say is to be done."""

import grpc
import plumescout
from plumescout import _operation, rpcs

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import system_service_pb2 as system_pb

ROBOT = "missions/m/robots/r"


def refusal(code, reason, **facts):
    return plumescout.PlumeScoutError(code, "refused", reason, **facts)


LINK_BROKE = refusal(grpc.StatusCode.UNAVAILABLE, "")


class FakeServer:
    """The log of one robot, as a server holds it; carries out operations."""

    def __init__(self):
        self.log = []  # numbers; a gap's as (first, last)
        self.boot_id = "first"
        self.knows_robot = True
        self.log_continues = True
        self.keeps = True
        self.lag = 0
        self.durable = 0
        self.errors = []  # of the next calls that send a batch
        self.calls = []  # (rpc, request)
        self.slept_s = []
        self.meanwhile = lambda: None  # what the robot does while a batch is under way

    @property
    def applied(self):
        last = self.log[-1] if self.log else 0
        return last[1] if isinstance(last, tuple) else last

    def fall_back_to(self, count):
        self.log = self.log[:count]
        self.durable = self.applied

    def lose_everything(self):
        self.fall_back_to(0)
        self.boot_id, self.knows_robot = "second", False

    def run(self, operation):
        progress = _operation.Progress(operation)
        while (effect := progress.advance()) is not None:
            try:
                progress.give(self.perform(effect))
            except plumescout.PlumeScoutError as error:
                progress.fail(error)
        return progress.result()

    def perform(self, effect):
        if isinstance(effect, _operation.Sleep):
            return self.slept_s.append(effect.seconds)
        if isinstance(effect, _operation.Open):
            return FakeStream(self)
        if isinstance(effect, _operation.Write):
            return effect.stream.write(effect.request)
        if isinstance(effect, _operation.EndWriting):
            return effect.stream.responses.append(None)
        if isinstance(effect, _operation.Read):
            return effect.stream.responses.pop(0)
        request = type(effect.request)()
        request.CopyFrom(effect.request)
        self.calls.append((effect.rpc, request))
        if effect.rpc is rpcs.GET_SERVER_INFO:
            limits = {"max_batch_observation_count": 4, "max_receive_bytes": 1 << 20}
            return system_pb.GetServerInfoResponse(boot_id=self.boot_id, limits=limits)
        if effect.rpc is rpcs.REGISTER_ROBOT:
            self.knows_robot = True
            return self.registration()
        if effect.rpc is rpcs.BATCH_INGEST_OBSERVATIONS:
            if self.errors and request.HasField("batch"):
                raise self.errors.pop(0)
            self.take(request)
            return ingest_pb.BatchIngestObservationsResponse(ingest_state=self.state())
        if effect.rpc is rpcs.NEXT_BEST_TRAJECTORY:
            return planning_pb.NextBestTrajectoryResponse(plan={"chosen_index": -1})
        if effect.rpc is rpcs.CHECK_TRAJECTORY:
            return planning_pb.CheckTrajectoryResponse()
        raise AssertionError(effect)

    def registration(self):
        return robot_pb.RegisterRobotResponse(
            robot=ROBOT,
            lease_token=len(self.calls) + 1,
            ingest_state=self.state(),
            server_boot_id=self.boot_id,
            log_continues=self.log_continues,
        )

    def state(self):
        return ingest_pb.IngestState(
            applied_sequence=self.applied,
            durable_sequence=self.durable,
            credit_sequence=self.applied + 6,
        )

    def take(self, request):
        """request: something with `open` and `batch`."""
        if request.HasField("batch"):
            self.meanwhile()
        if not self.knows_robot:
            raise refusal(grpc.StatusCode.NOT_FOUND, "ROBOT_NOT_FOUND")
        if request.open.durable_sequence > self.applied:
            applied = {"applied_sequence": str(self.applied)}
            raise refusal(
                grpc.StatusCode.FAILED_PRECONDITION, "STORE_ROLLED_BACK", metadata=applied
            )
        for observation in request.batch.observations:
            if observation.sequence > self.applied + 1:
                raise refusal(grpc.StatusCode.FAILED_PRECONDITION, "SEQUENCE_GAP")
            gap = observation.gap if observation.HasField("gap") else None
            self.log.append(
                (gap.first_sequence, gap.last_sequence) if gap else observation.sequence
            )
        if self.keeps:
            self.durable = max(self.durable, self.applied - self.lag)


class FakeStream:
    """An ingest stream to a FakeServer."""

    def __init__(self, server):
        self.server = server
        self.responses = []

    def write(self, request):
        assert None not in self.responses, "a request after the last"
        response = ingest_pb.StreamObservationsResponse()
        if request.HasField("open"):
            self.server.take(ingest_pb.BatchIngestObservationsRequest(open=request.open))
            response.opened.ingest_state.CopyFrom(self.server.state())
        else:
            self.server.take(ingest_pb.BatchIngestObservationsRequest(batch=request.batch))
            response.ack.CopyFrom(self.server.state())
        self.responses.append(response)
