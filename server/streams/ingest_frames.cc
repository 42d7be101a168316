// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/ingest_frames.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/observation.h"
#include "proto/convert/status.h"
#include "server/base/errors.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

constexpr char kObservation[] = "observation";

}  // namespace

v1::IngestState ToIngestState(const LogPosition& position, const RobotId& robot,
                              const MissionJournal& journal, int window) {
  v1::IngestState proto;
  proto.set_applied_sequence(position.applied_sequence);
  proto.set_durable_sequence(journal.DurableSequence(robot, position.applied_sequence));
  proto.set_credit_sequence(CreditSequence(position, journal.WindowNow(window)));
  proto.set_revision(position.revision);
  return proto;
}

absl::Status CheckNotRolledBack(const v1::OpenIngest& open, const LogPosition& position,
                                MissionMetrics& metrics) {
  if (open.durable_sequence() <= position.applied_sequence) return absl::OkStatus();
  metrics.NoteRollback();
  LogWarning("the data of the server is older than what it told a robot",
             {{"robot", open.robot()},
              {"applied_sequence", absl::StrCat(position.applied_sequence)},
              {"durable_sequence", absl::StrCat(open.durable_sequence())}});
  return StoreRolledBack(position.applied_sequence, open.durable_sequence());
}

v1::ObservationRejected ToRejected(const RefusedObservation& refused) {
  v1::ObservationRejected proto;
  proto.set_sequence(refused.sequence);
  *proto.mutable_status() = ToProto(WithErrorInfo(RefusalFromCore(refused.status, kObservation)));
  return proto;
}

absl::StatusOr<std::vector<IncomingObservation>> ReadBatch(const v1::ObservationBatch& batch,
                                                           int max_observations) {
  if (batch.observations_size() < 1 || batch.observations_size() > max_observations) {
    return FieldError("batch.observations", batch.observations_size(),
                      absl::StrCat("entries; must be 1 to ", max_observations));
  }
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("batch.sent_time_ns", batch.sent_time_ns(), 0, kMaxTime_ns));
  std::vector<IncomingObservation> incoming;
  incoming.reserve(static_cast<std::size_t>(batch.observations_size()));
  for (int i = 0; i < batch.observations_size(); ++i) {
    const v1::Observation& proto = batch.observations(i);
    const std::string field = Join(Join("batch", "observations", i), "sequence");
    PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(field, proto.sequence(), 1, kMaxSequence));
    auto observation = FromProto(proto, kObservation);
    if (observation.ok()) {
      incoming.push_back({*std::move(observation), absl::OkStatus()});
    } else {
      incoming.push_back({{}, observation.status()});
      incoming.back().observation.sequence = proto.sequence();
    }
  }
  return incoming;
}

}  // namespace plumescout::server
