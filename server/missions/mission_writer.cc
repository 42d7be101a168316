// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_writer.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/species.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

MissionSummary SummaryOf(const Mission& mission) {
  return {mission.revision(),     mission.phase(),          mission.next_map_update_ns(),
          mission.memory_bytes(), mission.lattice_factor(), mission.shared_options(),
          mission.objective()};
}

// Of all fields that there are.
std::vector<std::shared_ptr<const AuditInputs>> MakeAudits(const Mission& mission) {
  std::vector<std::shared_ptr<const AuditInputs>> audits;
  for (std::size_t i = 0; i < mission.species_count(); ++i) {
    if (auto audit = mission.MakeAudit(i)) audits.push_back(std::move(audit));
  }
  return audits;
}

bool IsReadingTakenIn(const Event& event, const Applied& applied) {
  const auto* received = std::get_if<ObservationReceived>(&event.body);
  return received != nullptr && applied.observation.ok() &&
         std::holds_alternative<GasReading>(received->observation.payload);
}

}  // namespace

MissionWriter::MissionWriter(std::unique_ptr<Mission> mission, AppliedSink sink,
                             WorkerPool* epoch_pool, SteadyClock clock, WorkerPool* audit_pool,
                             MissionMetrics* metrics, const EpochHabit& habit)
    : sink_(std::move(sink)),
      clock_(std::move(clock)),
      metrics_(*metrics),
      epoch_runner_(epoch_pool, metrics),
      map_work_(epoch_pool),
      audit_runner_(audit_pool),
      gas_timer_(metrics),
      conduct_(std::move(mission), this, habit),
      summary_(SummaryOf(conduct_.mission())) {
  // A mission that is recovered may be in the middle of one.
  if (conduct_.mission().epoch() != nullptr) epoch_runner_.Start(conduct_.mission().epoch());
  if (conduct_.mission().rebuild() != nullptr) AfterMapRebuildBegun();
}

MissionSummary MissionWriter::summary() const {
  absl::MutexLock lock(&summary_mutex_);
  return summary_;
}

void MissionWriter::OnEvent(const Event& event, const Applied& applied) {
  if (sink_) sink_(event, applied);
  if (std::holds_alternative<ObservationReceived>(event.body)) {
    metrics_.NoteObservation(applied.observation.ok());
  }
  if (applied.turned_suspect) {
    LogWarning("robot has lost its place: its scans contradict the map",
               {{"robot", std::get<ObservationReceived>(event.body).robot},
                {"revision", absl::StrCat(applied.revision)}});
  }
  if (!applied.map.ok()) {
    LogWarning("a map rebuilt with corrected poses is not taken: the old one stays",
               {{"why", std::string(applied.map.message())},
                {"revision", absl::StrCat(applied.revision)}});
  }
  if (IsReadingTakenIn(event, applied)) gas_timer_.NoteReading(clock_());
  absl::MutexLock lock(&summary_mutex_);
  if (summary_.lattice_factor != mission().lattice_factor()) {
    LogInfo("gas lattice made coarser",
            {{"lattice_factor", absl::StrCat(mission().lattice_factor())},
             {"memory_bytes", absl::StrCat(mission().memory_bytes())}});
  }
  summary_ = SummaryOf(mission());
}

void MissionWriter::AfterMapRebuildBegun() {
  map_work_.Start([rebuild = mission().rebuild()] { rebuild->Recompute(); });
}

void MissionWriter::BeforeGasStep(GasStep step) {
  gas_step_from_ = clock_();
  if (step == GasStep::kAdoptEpoch) epoch_runner_.Finish();
}

void MissionWriter::AfterGasStep(GasStep step, const absl::Status& status) {
  if (absl::IsCancelled(status)) return;  // the mission ends
  if (!status.ok()) {
    metrics_.NoteGasFailure();
    return LogWarning("gas posterior not kept up", {{"why", std::string(status.message())}});
  }
  switch (step) {
    case GasStep::kAdoptEpoch:
      gas_timer_.NoteAdoption(gas_step_from_, clock_());
      if (mission().audit_due() && audit_runner_.is_free()) {
        audit_runner_.Start(MakeAudits(mission()));
      }
      return;
    case GasStep::kRefresh:
      return gas_timer_.NoteRefresh(gas_step_from_, clock_());
    case GasStep::kBeginEpoch:
      return epoch_runner_.Start(mission().epoch());
  }
}

void MissionWriter::CollectAudit() {
  while (const auto finding = audit_runner_.Take()) {
    metrics_.NoteAudit(*finding);
    if (finding->ok()) {
      TakeFinding(**finding);
    } else {
      LogWarning("gas posterior not audited", {{"why", std::string(finding->status().message())}});
    }
  }
}

void MissionWriter::TakeFinding(const AuditFinding& found) {
  if (!found.certified) {
    LogWarning("gas posterior is not what it should be, and is made anew",
               {{"mean_ppm", absl::StrCat(found.mean_ppm)},
                {"variance_ratio", absl::StrCat(found.variance_ratio)},
                {"species", SpeciesName(mission().options(), found.species)}});
  }
  conduct_.TakeFinding(found);
}

std::shared_ptr<const Belief> MissionWriter::Publish(absl::Duration gas_wait) {
  const SteadyTime now = clock_();
  const bool waits = !gas_timer_.unpublished_in_posterior();
  if (waits && now >= After(unpublished_since(), gas_wait) && !conduct_.Refresh().ok()) {
    gas_timer_.Restart(now);  // to be tried again, but not at once
  }
  auto belief = conduct_.Snapshot();
  gas_timer_.NotePublication(clock_());
  return belief;
}

}  // namespace plumescout::server
