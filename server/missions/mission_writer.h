// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/mission/conduct/conduct_observer.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "core/types/objective.h"
#include "server/base/clock.h"
#include "server/base/worker_pool.h"
#include "server/missions/audit_runner.h"
#include "server/missions/epoch_runner.h"
#include "server/missions/gas_timings.h"
#include "server/missions/side_work.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

// Hears of every event in the order in which the mission applied it.
using EventSink = std::function<void(const Event&)>;
// Likewise, and of what became of it.
using AppliedSink = std::function<void(const Event&, const Applied&)>;

// What lists say of a mission.
struct MissionSummary {
  std::int64_t revision = 0;
  MissionPhase phase = MissionPhase::kExploring;
  std::optional<std::int64_t> next_map_update_ns;
  std::int64_t memory_bytes = 0;                  // see Mission::memory_bytes
  int lattice_factor = 1;                         // of the gas field now
  std::shared_ptr<const MissionOptions> options;  // in force
  std::optional<ObjectiveStatus> objective;       // none: a complete map
};

// The conduct of one mission on its writer's thread: has epochs recomputed on a pool, takes times,
// tells of events and publishes to those who watch. Single-threaded, but for summary() and
// gas_timings().
class MissionWriter final : private ConductObserver {
 public:
  // `epoch_pool` recomputes the gas posterior at times, and maps; null: the writer does. It is not
  // owned and outlives the last call. The events are the same with any pool and clock. `audit_pool`
  // audits it, null: nobody does; as above. `metrics` is not owned either. `habit`: as
  // MissionConduct.
  MissionWriter(std::unique_ptr<Mission> mission, AppliedSink sink,
                WorkerPool* epoch_pool = nullptr, SteadyClock clock = SteadyNow,
                WorkerPool* audit_pool = nullptr,
                MissionMetrics* metrics = &MissionMetrics::Unread(), const EpochHabit& habit = {});
  MissionWriter(const MissionWriter&) = delete;
  MissionWriter& operator=(const MissionWriter&) = delete;

  MissionConduct& conduct() { return conduct_; }
  MissionMetrics& metrics() { return metrics_; }
  // Observations that arrived then have been applied.
  void NoteIngest(SteadyTime arrived) { metrics_.NoteIngest(absl::FromChrono(clock_() - arrived)); }
  const Mission& mission() const { return conduct_.mission(); }
  // From any thread. Never behind an event whose caller has been answered.
  MissionSummary summary() const;
  GasTimings gas_timings() const { return gas_timer_.timings(); }

  // Counts what an audit has found, if one has ended since, and mends what it blames. What is
  // mended, and when, is an event.
  void CollectAudit();
  // As AuditRunner::OnFinding; to be called before anything is applied.
  void OnAuditFinding(std::function<void()> told) { audit_runner_.OnFinding(std::move(told)); }

  // For those who watch: a snapshot whose posterior holds every reading that was applied
  // `gas_wait` ago or earlier. If no observation has led to the refresh for that, this does.
  std::shared_ptr<const Belief> Publish(absl::Duration gas_wait);
  // When the first reading was applied that Publish has not given out; max() if there is none.
  SteadyTime unpublished_since() const { return gas_timer_.unpublished_since(); }
  // Nobody has watched until now.
  void BeginPublishing() { gas_timer_.Restart(clock_()); }

 private:
  void OnEvent(const Event& event, const Applied& applied) override;
  void BeforeGasStep(GasStep step) override;
  void AfterGasStep(GasStep step, const absl::Status& status) override;
  void BeforeMapRebuilt() override { map_work_.Finish(); }
  void AfterMapRebuildBegun() override;
  void TakeFinding(const AuditFinding& found);

  AppliedSink sink_;
  const SteadyClock clock_;
  MissionMetrics& metrics_;
  EpochRunner epoch_runner_;
  SideWork map_work_;
  AuditRunner audit_runner_;
  GasTimer gas_timer_;
  SteadyTime gas_step_from_;
  MissionConduct conduct_;

  mutable absl::Mutex summary_mutex_;
  MissionSummary summary_ ABSL_GUARDED_BY(summary_mutex_);
};

}  // namespace plumescout::server
