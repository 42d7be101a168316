// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_recovery.h"

#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "plumescout/v1/options.pb.h"
#include "proto/convert/options.h"
#include "server/base/log.h"
#include "server/missions/mission_snapshot.h"

namespace plumescout::server {
namespace {

constexpr std::int64_t kNow = std::numeric_limits<std::int64_t>::max();

absl::Status Unusable(const std::string& key, std::int64_t number, absl::string_view why) {
  return absl::DataLossError(absl::StrCat("mission ", key, ", event ", number, ": ", why));
}

// Says whether the event adopted an epoch.
absl::StatusOr<bool> ApplyRecord(const std::string& key, const JournalRecord& record,
                                 Mission& mission) {
  if (record.number != mission.revision() + 1) {
    return Unusable(key, record.number, absl::StrCat("stands after event ", mission.revision()));
  }
  auto event = DecodeEvent(record.bytes);
  if (!event.ok()) return Unusable(key, record.number, event.status().message());
  if (event->number != record.number) {
    return Unusable(key, record.number, absl::StrCat("calls itself ", event->number));
  }
  const auto applied = mission.Apply(event->body);
  if (absl::IsCancelled(applied.status())) return applied.status();
  if (!applied.ok()) return Unusable(key, record.number, applied.status().message());
  return std::holds_alternative<EpochAdopted>(event->body);
}

struct Rebuilt {
  std::unique_ptr<Mission> mission;
  JournalTail tail;
  std::int64_t first_kept = 1;  // number of an event
};

// The events after the mission's revision, up to `revision`.
absl::Status Replay(MissionStore& store, const std::string& key, std::int64_t revision,
                    const StopFn& stop, Rebuilt& rebuilt) {
  Mission& mission = *rebuilt.mission;
  if (mission.revision() >= revision) return absl::OkStatus();
  mission.AbandonWhen(stop);
  if (mission.revision() + 1 < rebuilt.first_kept) {
    // Of what was before no snapshot serves.
    return revision == kNow
               ? Unusable(key, rebuilt.first_kept - 1, "is not kept any more")
               : absl::OutOfRangeError(absl::StrCat("mission ", key, " keeps no events up to ",
                                                    rebuilt.first_kept - 1, " any more"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto reader, store.Read(key, mission.revision() + 1));
  while (mission.revision() < revision) {
    if (stop()) return absl::CancelledError("the server goes down");
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<JournalRecord> record, reader->Next());
    if (!record.has_value()) break;
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_epoch, ApplyRecord(key, *record, mission));
    if (is_epoch) rebuilt.tail.last_epoch = mission.revision();
    rebuilt.tail.bytes += std::ssize(record->bytes);
  }
  return absl::OkStatus();
}

// Of the newest snapshot that serves, or else of nothing.
absl::StatusOr<Rebuilt> BeginWith(const std::string& key, const MissionOptions& options,
                                  const std::vector<StoredSnapshot>& snapshots,
                                  std::int64_t revision, const StopFn& stop) {
  for (const StoredSnapshot& snapshot : snapshots) {
    if (snapshot.revision > revision) continue;
    auto mission = RestoreSnapshot(snapshot, options, stop);
    if (mission.ok()) {
      return Rebuilt{
          *std::move(mission),
          {.snapshot_bytes = std::ssize(snapshot.bytes), .last_epoch = snapshot.revision}};
    }
    if (absl::IsCancelled(mission.status())) return mission.status();
    LogWarning("snapshot passed over", {{"mission", key},
                                        {"revision", absl::StrCat(snapshot.revision)},
                                        {"why", std::string(mission.status().message())}});
  }
  auto mission = Mission::Create(options);
  if (!mission.ok()) return Unusable(key, 0, mission.status().message());
  return Rebuilt{*std::move(mission), {}};
}

absl::StatusOr<Rebuilt> Rebuild(MissionStore& store, const std::string& key,
                                const AcquiredMission& kept, std::int64_t revision,
                                const StopFn& stop) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const JournalStart start, DecodeStart(kept.header));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionOptions options, OptionsOf(start));
  PLUMESCOUT_ASSIGN_OR_RETURN(Rebuilt rebuilt,
                              BeginWith(key, options, kept.snapshots, revision, stop));
  rebuilt.first_kept = kept.first;
  PLUMESCOUT_RETURN_IF_ERROR(Replay(store, key, revision, stop, rebuilt));
  if (revision != kNow && rebuilt.mission->revision() < revision) {
    return absl::OutOfRangeError(absl::StrCat("mission ", key, " has events up to ",
                                              rebuilt.mission->revision(), ", but no ", revision));
  }
  return rebuilt;
}

}  // namespace

JournalStart StartOf(JournalStart start, const MissionOptions& options) {
  start.mission_options = ToProto(options).SerializeAsString();
  return start;
}

std::string EncodeMissionStart(const JournalStart& start, const MissionOptions& options) {
  return EncodeStart(StartOf(start, options));
}

absl::StatusOr<MissionOptions> OptionsOf(const JournalStart& start) {
  v1::MissionOptions proto;
  if (!proto.ParseFromString(start.mission_options)) {
    return absl::DataLossError("the options of the mission cannot be read");
  }
  const auto options = FromProto(proto, RecordedDefaults(), "options");
  if (options.ok()) return options;
  return absl::DataLossError(options.status().message());
}

absl::StatusOr<std::unique_ptr<Mission>> MissionAt(MissionStore& store, const std::string& key,
                                                   std::int64_t revision, const StopFn& stop) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission kept, store.Peek(key));
  PLUMESCOUT_ASSIGN_OR_RETURN(Rebuilt rebuilt, Rebuild(store, key, kept, revision, stop));
  return std::move(rebuilt.mission);
}

bool IsUnfinishedImport(const AcquiredMission& stored) {
  const auto start = DecodeStart(stored.header);
  return start.ok() && start->last_number > 0 && stored.standing.empty();
}

absl::StatusOr<RecoveredMission> RecoverMission(MissionStore& store, const std::string& key,
                                                const StopFn& stop, std::int64_t* epoch) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission kept, store.Acquire(key));
  if (epoch != nullptr) *epoch = kept.epoch;
  if (IsUnfinishedImport(kept)) {
    return absl::DataLossError(absl::StrCat(
        "mission ", key, " is an import that did not end; delete it, and import again"));
  }
  RecoveredMission recovered;
  PLUMESCOUT_ASSIGN_OR_RETURN(recovered.start, DecodeStart(kept.header));
  PLUMESCOUT_ASSIGN_OR_RETURN(recovered.standing, DecodeStanding(kept.standing));
  PLUMESCOUT_ASSIGN_OR_RETURN(Rebuilt rebuilt, Rebuild(store, key, kept, kNow, stop));
  recovered.mission = std::move(rebuilt.mission);
  recovered.tail = rebuilt.tail;
  recovered.epoch = kept.epoch;
  recovered.head = kept.head;
  if (recovered.mission->revision() != kept.head) {
    return Unusable(key, recovered.mission->revision() + 1,
                    absl::StrCat("is missing; there were events up to ", kept.head));
  }
  return recovered;
}

}  // namespace plumescout::server
