// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <array>
#include <cstdint>
#include <map>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/gas/field_audit.h"
#include "core/types/robot_notice.h"
#include "server/base/stage_times.h"

namespace plumescout::server {

// Counts and times what missions do, all of them together: the number of series does not follow
// that of missions. Thread-safe.
class MissionMetrics {
 public:
  // The registry outlives it.
  explicit MissionMetrics(prometheus::Registry& registry);
  // Metrics that nobody reads.
  static MissionMetrics& Unread();

  // A robot was told that more of its log is durable than the mission has.
  void NoteRollback() { rollbacks_->Increment(); }
  void NoteObservation(bool applied) { (applied ? applied_ : rejected_)->Increment(); }
  // From the arrival of a batch until it was applied.
  void NoteIngest(absl::Duration lag) { Observe(*ingest_lag_, lag); }

  // The writer's time for a step of the gas field.
  void NoteRefresh(absl::Duration time) { Observe(*refresh_, time); }
  void NoteAdoption(absl::Duration time) { Observe(*adoption_, time); }
  // The time to recompute an epoch, whoever did it.
  void NoteEpoch(absl::Duration time) { Observe(*epoch_, time); }
  void NoteGasFailure() { gas_failures_->Increment(); }
  // Between the acknowledgement of a reading and the publication of the first belief with it.
  void NoteStaleness(absl::Duration time) { Observe(*staleness_, time); }
  // Of files that missions are recorded in; of events that are missing there; of files that could
  // not be written.
  void NoteRecordedBytes(std::int64_t bytes) {
    recorded_bytes_->Increment(static_cast<double>(bytes));
  }
  void NoteRecordingDrop() { recording_drops_->Increment(); }
  void NoteRecordingFailure() { recording_failures_->Increment(); }
  void NoteAudit(const absl::StatusOr<AuditFinding>& finding);

  void NotePlanStage(Stage stage, absl::Duration time);
  void NotePlan(absl::Duration cpu_time);  // that was committed
  void NotePlanInvalidated(InvalidationReason reason);

 private:
  static void Observe(prometheus::Histogram& histogram, absl::Duration time) {
    histogram.Observe(absl::ToDoubleSeconds(time));
  }

  // Of the registry.
  prometheus::Counter* applied_ = nullptr;
  prometheus::Counter* rejected_ = nullptr;
  prometheus::Counter* rollbacks_ = nullptr;
  prometheus::Histogram* ingest_lag_ = nullptr;
  prometheus::Histogram* refresh_ = nullptr;
  prometheus::Histogram* adoption_ = nullptr;
  prometheus::Histogram* epoch_ = nullptr;
  prometheus::Counter* gas_failures_ = nullptr;
  prometheus::Histogram* staleness_ = nullptr;
  prometheus::Counter* recorded_bytes_ = nullptr;
  prometheus::Counter* recording_drops_ = nullptr;
  prometheus::Counter* recording_failures_ = nullptr;
  prometheus::Counter* audits_certified_ = nullptr;
  prometheus::Counter* audits_alarmed_ = nullptr;
  prometheus::Counter* audits_failed_ = nullptr;
  // By the gas's place among its mission's.
  prometheus::Family<prometheus::Gauge>* audit_mean_ = nullptr;
  prometheus::Family<prometheus::Gauge>* audit_variance_ = nullptr;
  std::array<prometheus::Histogram*, kStageNames.size()> plan_stages_ = {};
  prometheus::Histogram* plan_cpu_ = nullptr;
  std::map<InvalidationReason, prometheus::Counter*> plans_invalidated_;
};

}  // namespace plumescout::server
