// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "core/mission/mission.h"
#include "core/types/stop.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_registry.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// What a past state is made for. Of each, a mission has one at a time.
enum class PastUse { kMap, kReplay, kExport, kFigures };

// A mission as it was, beside the one that goes on.
struct PastMission {
  std::shared_ptr<void> room;  // held as long as the mission is there
  std::unique_ptr<Mission> mission;
};

// Makes missions as they were from what is stored of them. Each takes the memory of a mission, up
// to the budget of that which it is of, and is counted with the others of the server. Thread-safe.
class PastMissions {
 public:
  // None is owned; both outlive what is made.
  PastMissions(MissionStore* store, MissionRegistry* registry)
      : store_(*store), registry_(*registry) {}

  MissionStore& store() { return store_; }

  // The mission after the event `revision`, 0: before the first. kInvalidArgument naming `field` if
  // that is negative, kOutOfRange naming it if it is not durable yet; OVERLOADED if another is made
  // for the same use; LIMIT_REACHED if the server has no memory left; kCancelled. May take some
  // seconds: not for reactors.
  absl::StatusOr<PastMission> Make(const MissionHost& host, std::int64_t revision,
                                   absl::string_view field, PastUse use, const StopFn& stop);

 private:
  using Place = std::pair<std::string, PastUse>;

  absl::StatusOr<std::shared_ptr<void>> TakePlace(const Place& place) ABSL_LOCKS_EXCLUDED(mutex_);

  MissionStore& store_;
  MissionRegistry& registry_;

  absl::Mutex mutex_;
  std::set<Place> taken_ ABSL_GUARDED_BY(mutex_);
};

// An event of the journal that the mission does not take as it once did. kDataLoss.
absl::Status ReplayDiffers(std::int64_t number, const absl::Status& why);

// How a store knows the mission.
inline std::string KeyOf(const MissionHost& host) { return MissionKey(host.tenant(), host.id()); }

}  // namespace plumescout::server
