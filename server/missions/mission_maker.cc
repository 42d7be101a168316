// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_maker.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/base/version.h"
#include "server/missions/mission_recovery.h"
#include "server/missions/recovery_list.h"

namespace plumescout::server {
namespace {

// 2^21 lives with 2^32 leases each; whoever lives longer goes by the tokens of its robots.
std::int64_t FirstLeaseTokenOf(std::int64_t epoch) {
  constexpr int kTokensPerLife_bits = 32;
  return epoch < (kLeaseTokenEnd >> kTokensPerLife_bits) ? epoch << kTokensPerLife_bits : 1;
}

}  // namespace

std::string MissionKey(absl::string_view tenant, const MissionId& id) {
  return tenant.empty() ? id : absl::StrCat(tenant, "/", id);  // no id has a slash
}

absl::Status MissionMaker::CheckChoices(const MissionOptions& options) const {
  const auto must_be_at_most = [](auto limit, absl::string_view option) {
    return absl::StrCat("must be at most the server's ", option, " = ", limit);
  };
  return Checker()
      .Require(options.memory_budget_bytes <= options_.mission_memory_budget_bytes,
               "memory_budget_bytes", options.memory_budget_bytes,
               must_be_at_most(options_.mission_memory_budget_bytes,
                               "limits.mission_memory_budget_bytes"))
      .Require(options.occupancy.max_cell_count <= options_.max_map_cell_count,
               "occupancy.max_cell_count", options.occupancy.max_cell_count,
               must_be_at_most(options_.max_map_cell_count, "limits.max_map_cell_count"))
      .Require(options.max_beam_count <= options_.max_beam_count, "max_beam_count",
               options.max_beam_count,
               must_be_at_most(options_.max_beam_count, "limits.max_beam_count"))
      .Require(options.max_range_m <= options_.max_range_m, "max_range_m", options.max_range_m,
               must_be_at_most(options_.max_range_m, "limits.max_range_m"))
      .status();
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionMaker::Make(const MissionId& id,
                                                                const MissionOptions& options,
                                                                const MissionOwner& owner) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(auto strategy, hooks_.make_strategy(options.planning));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(options));
  JournalHome home{.key = MissionKey(owner.tenant, id)};
  const JournalStart start{.code_version = kVersion,
                           .mission_options = {},
                           .mission = id,
                           .owner = owner.name,
                           .tenant = owner.tenant,
                           .created_ns = options_.host.wall_clock()};
  if (hooks_.store != nullptr) {
    const auto epoch =
        hooks_.store->Create(home.key, EncodeMissionStart(start, mission->options()));
    if (absl::IsUnavailable(epoch.status())) return StoreTakesNothing(epoch.status().message());
    PLUMESCOUT_RETURN_IF_ERROR(epoch.status());
    home.epoch = *epoch;
  }
  return MakeHost(
      {.id = id, .mission = std::move(mission), .strategy = std::move(strategy), .owner = owner},
      std::move(home), start);
}

std::shared_ptr<MissionHost> MissionMaker::MakeHost(MissionHost::Parts parts, JournalHome home,
                                                    const JournalStart& start) const {
  HostOptions options = options_.host;
  if (hooks_.clock) options.clock = hooks_.clock;
  if (hooks_.wall_clock) options.wall_clock = hooks_.wall_clock;
  if (hooks_.store != nullptr && hooks_.store->is_durable()) {
    // Of each life of the mission, which its robots' leases outlive, greater than of the one
    // before.
    options.first_lease_token = FirstLeaseTokenOf(home.epoch);
  }
  if (hooks_.recorder != nullptr) {
    parts.recording = hooks_.recorder->Begin(StartOf(start, parts.mission->options()), home.key);
  }
  home.store = hooks_.store;
  home.max_backlog_bytes = options_.max_backlog_bytes;
  parts.journal = std::make_shared<MissionJournal>(std::move(home));
  if (hooks_.make_event_sink) {
    parts.sink = hooks_.make_event_sink(parts.id, parts.mission->options());
  }
  parts.epoch_pool = hooks_.epoch_pool;
  parts.audit_pool = hooks_.audit_pool;
  parts.snapshot_pool = hooks_.snapshot_pool;
  parts.metrics = hooks_.metrics;
  auto host = std::make_shared<MissionHost>(std::move(parts), options);
  host->journal().WhenLost([weak = std::weak_ptr(host), id = host->id()](const absl::Status& lost) {
    LogError("mission lost", {{"mission", id}, {"why", std::string(lost.message())}});
    if (const auto fenced = weak.lock()) fenced->BeginStop(lost);
  });
  return host;
}

absl::StatusOr<std::int64_t> MissionMaker::StoredBudget_bytes(const std::string& key) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission kept, hooks_.store->Peek(key));
  PLUMESCOUT_ASSIGN_OR_RETURN(const JournalStart start, DecodeStart(kept.header));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionOptions options, OptionsOf(start));
  return options.memory_budget_bytes;
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionMaker::Revive(const std::string& key,
                                                                  const StopFn& stop,
                                                                  std::int64_t* epoch) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(RecoveredMission recovered,
                              RecoverMission(*hooks_.store, key, stop, epoch));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto strategy,
                              hooks_.make_strategy(recovered.mission->options().planning));
  return MakeHost({.id = MissionIdOf(key),
                   .mission = std::move(recovered.mission),
                   .strategy = std::move(strategy),
                   .owner = {recovered.start.owner, TenantOf(key)},
                   .standing = std::move(recovered.standing),
                   .tail = recovered.tail},
                  {.key = key, .epoch = recovered.epoch, .head = recovered.head}, recovered.start);
}

}  // namespace plumescout::server
