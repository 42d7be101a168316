// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "absl/synchronization/notification.h"
#include "core/mission/mission.h"
#include "formats/journal/event_codec.h"
#include "proto/convert/status.h"
#include "server/missions/mission_recovery.h"
#include "server/missions/mission_registry.h"
#include "server/store/mission_store.h"
#include "tests/server/stored_run.h"

namespace plumescout::server {

// kInvalidArgument that names this one field.
MATCHER_P(Blames, field, "") {
  *result_listener << arg;
  const std::vector<FieldViolation> violations = FieldViolations(arg);
  return absl::IsInvalidArgument(arg) && violations.size() == 1 && violations[0].field == field;
}

// kOutOfRange that names this one field.
MATCHER_P(IsNotYet, field, "") {
  *result_listener << arg;
  const std::vector<FieldViolation> violations = FieldViolations(arg);
  return absl::IsOutOfRange(arg) && violations.size() == 1 && violations[0].field == field;
}

inline RegistryOptions WithMemory(std::int64_t budget_bytes) {
  RegistryOptions options;
  options.memory_budget_bytes = budget_bytes;
  return options;
}

// A mission in a store, and what it came from.
struct PastRun {
  std::vector<Event> events;
  std::uint64_t digest = 0;  // of the last state

  std::int64_t revision() const { return static_cast<std::int64_t>(events.size()); }
};

// Has the store keep a mission of this name, in which a robot has driven around a room.
inline PastRun StoreRun(MissionStore& store, const std::string& id = "hall",
                        const MissionOptions& options = {}) {
  PastRun run;
  run.events = RoomRunEvents(options);
  Mission mission(options);
  for (const Event& event : run.events) EXPECT_TRUE(mission.Apply(event.body).ok());
  EXPECT_TRUE(mission.Apply(PosteriorRefreshed{mission.sample_time_ns()}).ok());
  run.events.push_back({mission.revision(), PosteriorRefreshed{mission.sample_time_ns()}});
  run.digest = mission.Digest();
  PutMission(store, id, options, run.events);
  return run;
}

// More events behind those that are there; returns when they are durable.
inline absl::Status AddEvents(MissionStore& store, const std::string& key, std::int64_t epoch,
                              const std::vector<Event>& events) {
  std::vector<std::string> records;
  for (const Event& event : events) records.push_back(EncodeEvent(event, PlanDetail::kForReplay));
  absl::Notification told;
  absl::Status added;
  store.Append(key, epoch, events.front().number, std::move(records),
               [&](const absl::Status& status) {
                 added = status;
                 told.Notify();
               });
  told.WaitForNotification();
  return added;
}

}  // namespace plumescout::server
