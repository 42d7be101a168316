// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/mission_metrics.h"

#include <cstddef>
#include <string>
#include <utility>

#include "server/observe/buckets.h"

namespace plumescout::server {
namespace {

prometheus::Family<prometheus::Counter>& Counters(prometheus::Registry& registry,
                                                  const std::string& name,
                                                  const std::string& help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

prometheus::Labels OfSpecies(std::size_t species) { return {{"species", std::to_string(species)}}; }

// With the first gas, which every mission has; others come with their first audit.
prometheus::Family<prometheus::Gauge>* MakeGaugesOfSpecies(prometheus::Registry& registry,
                                                           const std::string& name,
                                                           const std::string& help) {
  auto& family = prometheus::BuildGauge().Name(name).Help(help).Register(registry);
  family.Add(OfSpecies(0));
  return &family;
}

prometheus::Family<prometheus::Histogram>& Times(prometheus::Registry& registry,
                                                 const std::string& name, const std::string& help) {
  return prometheus::BuildHistogram().Name(name).Help(help).Register(registry);
}

prometheus::Histogram* MakeTimes(prometheus::Registry& registry, const std::string& name,
                                 const std::string& help) {
  return &Times(registry, name, help).Add({}, DurationBuckets_s());
}

constexpr std::pair<InvalidationReason, const char*> kReasonNames[] = {
    {InvalidationReason::kMeetsRobot, "meets_robot"},
    {InvalidationReason::kWayBlocked, "way_blocked"},
    {InvalidationReason::kKeptOut, "kept_out"},
    {InvalidationReason::kSuperseded, "superseded"},
    {InvalidationReason::kLapsed, "lapsed"},
};

}  // namespace

MissionMetrics::MissionMetrics(prometheus::Registry& registry) {
  auto& observations = Counters(registry, "plumescout_observations_total",
                                "Observations that missions took in or refused.");
  applied_ = &observations.Add({{"outcome", "applied"}});
  rejected_ = &observations.Add({{"outcome", "rejected"}});
  rollbacks_ = &Counters(registry, "plumescout_store_rollbacks_total",
                         "Robots that were told more is durable than the server has now.")
                    .Add({});
  ingest_lag_ = MakeTimes(registry, "plumescout_ingest_lag_seconds",
                          "Time from the arrival of a batch of observations until it is applied.");
  refresh_ = MakeTimes(registry, "plumescout_gas_refresh_duration_seconds",
                       "Time that a mission's writer takes to bring its gas field up to date.");
  adoption_ = MakeTimes(registry, "plumescout_gas_adoption_duration_seconds",
                        "Time that a mission's writer takes to adopt a recomputed gas field.");
  epoch_ = MakeTimes(registry, "plumescout_gas_epoch_duration_seconds",
                     "Time to recompute a gas field beside its mission.");
  gas_failures_ = &Counters(registry, "plumescout_gas_failures_total",
                            "Refreshes, epochs and adoptions that came to nothing.")
                       .Add({});
  staleness_ = MakeTimes(registry, "plumescout_belief_staleness_seconds",
                         "Time from a reading's acknowledgement until watchers have it.");
  recorded_bytes_ = &Counters(registry, "plumescout_recorded_bytes_total",
                              "Bytes of MCAP files that missions were recorded in.")
                         .Add({});
  recording_drops_ = &Counters(registry, "plumescout_recording_dropped_events_total",
                               "Events that are missing in recordings.")
                          .Add({});
  recording_failures_ = &Counters(registry, "plumescout_recording_failures_total",
                                  "Recordings that stopped because the disk took no more.")
                             .Add({});
  auto& audits = Counters(registry, "plumescout_gas_audits_total",
                          "Audits of gas fields by an independent computation.");
  audits_certified_ = &audits.Add({{"outcome", "certified"}});
  audits_alarmed_ = &audits.Add({{"outcome", "alarm"}});
  audits_failed_ = &audits.Add({{"outcome", "failed"}});
  audit_mean_ =
      MakeGaugesOfSpecies(registry, "plumescout_gas_audit_mean_difference_ppm",
                          "Largest difference of means that the last audit of such a gas found.");
  audit_variance_ = MakeGaugesOfSpecies(
      registry, "plumescout_gas_audit_variance_difference_ratio",
      "Largest difference of variances that the last audit of such a gas found.");
  auto& stages =
      Times(registry, "plumescout_plan_stage_duration_seconds",
            "Time of a plan by stage: wait for its belief, for a thread, search, commit, disk.");
  for (const Stage stage :
       {Stage::kBelief, Stage::kQueue, Stage::kSearch, Stage::kCommit, Stage::kDurable}) {
    const auto index = static_cast<std::size_t>(stage);
    plan_stages_[index] =
        &stages.Add({{"stage", std::string(kStageNames[index])}}, DurationBuckets_s());
  }
  plan_cpu_ = MakeTimes(registry, "plumescout_plan_cpu_seconds",
                        "CPU time of all searches for a plan that was committed.");
  auto& invalidated = Counters(registry, "plumescout_plans_invalidated_total",
                               "Plans that robots were told not to drive any farther.");
  for (const auto& [reason, name] : kReasonNames) {
    plans_invalidated_[reason] = &invalidated.Add({{"reason", name}});
  }
}

MissionMetrics& MissionMetrics::Unread() {
  static auto& registry = *new prometheus::Registry();
  static auto& metrics = *new MissionMetrics(registry);
  return metrics;
}

void MissionMetrics::NoteAudit(const absl::StatusOr<AuditFinding>& finding) {
  if (!finding.ok()) return audits_failed_->Increment();
  (finding->certified ? audits_certified_ : audits_alarmed_)->Increment();
  const prometheus::Labels species = OfSpecies(finding->species);
  audit_mean_->Add(species).Set(finding->mean_ppm);
  audit_variance_->Add(species).Set(finding->variance_ratio);
}

void MissionMetrics::NotePlanStage(Stage stage, absl::Duration time) {
  auto* const histogram = plan_stages_[static_cast<std::size_t>(stage)];
  if (histogram != nullptr) Observe(*histogram, time);
}

void MissionMetrics::NotePlanInvalidated(InvalidationReason reason) {
  plans_invalidated_.at(reason)->Increment();
}

void MissionMetrics::NotePlan(absl::Duration cpu_time) { Observe(*plan_cpu_, cpu_time); }

}  // namespace plumescout::server
