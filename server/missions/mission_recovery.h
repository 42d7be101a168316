// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "core/mission/mission.h"
#include "core/types/options.h"
#include "core/types/stop.h"
#include "formats/journal/event_codec.h"
#include "server/missions/snapshot_taker.h"
#include "server/missions/standing_record.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// What the journal of a mission begins with, and the options that stand in it: those that the
// mission has, as it was fitted to its budget. kDataLoss if they are none.
JournalStart StartOf(JournalStart start, const MissionOptions& options);
std::string EncodeMissionStart(const JournalStart& start, const MissionOptions& options);
absl::StatusOr<MissionOptions> OptionsOf(const JournalStart& start);

// The mission as it was after this event: of the newest snapshot before it that makes the mission
// it was taken of, or else from the first event on. max(): as the store has it now. kNotFound;
// kOutOfRange if there is no such event yet, or it is not kept any more; kDataLoss, naming the
// record, if one cannot be read or applied; kCancelled soon after `stop` says so. Takes as long as
// the events took the mission.
absl::StatusOr<std::unique_ptr<Mission>> MissionAt(MissionStore& store, const std::string& key,
                                                   std::int64_t revision, const StopFn& stop);

// Whether it is what an import has left behind that did not end: that begins with the number of its
// last event, and ends with the mission's standing. That its events are fewer does not say so: a
// store may have lost them later.
bool IsUnfinishedImport(const AcquiredMission& stored);

// A mission that this server has taken over.
struct RecoveredMission {
  std::unique_ptr<Mission> mission;
  JournalStart start;
  StandingRecord standing;
  std::int64_t epoch = 0;
  std::int64_t head = 0;
  JournalTail tail;  // what was replayed
};

// Takes the mission over and brings it to where its durable events left it. Errors as MissionAt;
// kDataLoss of an import that did not end on another server. `epoch`, if there is one, is set as
// soon as the mission is taken over, also if it cannot be read then.
absl::StatusOr<RecoveredMission> RecoverMission(MissionStore& store, const std::string& key,
                                                const StopFn& stop, std::int64_t* epoch = nullptr);

}  // namespace plumescout::server
