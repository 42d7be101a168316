// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "absl/time/time.h"
#include "core/types/ids.h"
#include "core/types/objective.h"
#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout::client {

// What is done to a mission, apart from how far its robots are.
enum class MissionState {
  kRunning,     // takes observations, plans
  kPaused,      // takes observations, plans nothing
  kFinished,    // is only read
  kRecovering,  // not in memory yet, since the server has just started
  kSleeping,    // not in memory, since nobody has used it for long: the first call wakes it
  kElsewhere,   // another of the servers that share a store has it: MissionDetails::node
  kDamaged,     // what is kept of it cannot be used
  kUnknown,     // the server says what this client does not know
};

// Which of a mission's events the server keeps on its disk.
enum class EventRetention { kAll, kSinceSnapshot };

// A time that was measured again and again.
struct LatencySummary {
  std::int64_t samples = 0;  // since the server started
  double median_s = 0.0;
  double p99_s = 0.0;
  double max_s = 0.0;

  friend bool operator==(const LatencySummary&, const LatencySummary&) = default;
};

// A mission as its service tells of it. Of one that is recovering, asleep, elsewhere or damaged,
// only name, state and node.
struct MissionDetails {
  MissionId id;
  MissionState state = MissionState::kUnknown;
  MissionOptions options = {};  // in force; the prior map from GetMission only
  std::int64_t revision = 0;    // number of the last applied event
  MissionPhase phase = MissionPhase::kExploring;
  int robot_count = 0;
  LatencySummary gas_update = {};     // to bring changes into the gas posterior
  LatencySummary gas_staleness = {};  // from a reading's acknowledgement until watchers have it
  // When the first of the live plans that sample sites will have its last sample, in the mission's
  // time; none without such a plan.
  std::optional<std::int64_t> next_map_update_ns = std::nullopt;
  std::string owner = {};
  absl::Duration idle_time_to_live = absl::InfiniteDuration();  // see MissionUpdate
  std::int64_t memory_used_bytes = 0;
  std::int64_t memory_budget_bytes = 0;
  EventRetention event_retention = EventRetention::kAll;
  std::optional<ObjectiveStatus> objective = std::nullopt;  // none: a complete map
  std::string objective_explanation = {};                   // that in a sentence
  std::string node = {};  // the server that has it, of several that share a store
};

}  // namespace plumescout::client
