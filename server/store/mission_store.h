// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace plumescout::server {

class StoreNodes;

// Where missions outlive the server: a journal of numbered records for each, the newest snapshots,
// and who may write. What a record or a snapshot says is no concern of the store's.
//
// A mission is known by its key (MissionKey). Whoever acquires it writes under an epoch that grows
// with each acquisition; writes under an older one are refused (FENCED), whatever clocks say.

// An entry of a journal: the event of this number, as formats/journal encodes it.
struct JournalRecord {
  std::int64_t number = 0;
  std::string bytes;

  friend bool operator==(const JournalRecord&, const JournalRecord&) = default;
};

// A mission's state once the event `revision` was applied.
struct StoredSnapshot {
  std::int64_t revision = 0;
  std::uint64_t digest = 0;  // of the mission that it makes; see Mission::Digest
  std::string bytes;

  friend bool operator==(const StoredSnapshot&, const StoredSnapshot&) = default;
};

// Reads records in the order of their numbers, with bounded memory. Single-threaded.
class JournalReader {
 public:
  virtual ~JournalReader() = default;

  // Nothing after the last one. kDataLoss, naming the file and the record, if a record is missing
  // or is not what was written.
  virtual absl::StatusOr<std::optional<JournalRecord>> Next() = 0;
};

// What lists say of a stored mission.
struct StoredMission {
  std::string key;
  std::int64_t epoch = 0;
  std::int64_t head = 0;      // number of the last record; 0: there is none
  std::int64_t bytes = 0;     // of header, standing, records and snapshots
  bool is_damaged = false;    // as servers that share the store have found
  std::string standing = {};  // as MissionStore::List tells it; empty if it is damaged, too

  friend bool operator==(const StoredMission&, const StoredMission&) = default;
};

// A mission that one may write from now on.
struct AcquiredMission {
  std::int64_t epoch = 0;
  std::int64_t head = 0;
  std::int64_t first = 1;  // number of the first record that is kept; see Trim
  std::string header;
  std::string standing;
  std::vector<StoredSnapshot> snapshots;  // newest first, at most two
};

// How the store itself is.
struct StoreState {
  absl::Status status;             // not OK while what was appended cannot be made durable
  std::int64_t backlog_bytes = 0;  // appended, not durable yet
  std::int64_t backlog_records = 0;
  std::int64_t commits = 0;       // so far
  std::int64_t slow_commits = 0;  // of them, longer than StoreOptions::slow_commit
  absl::Duration last_commit;     // how long it took
};

// Thread-safe. Callbacks run on a thread of the store's and must not block; each is called exactly
// once, also when the store is destroyed (kCancelled).
class MissionStore {
 public:
  using Done = std::function<void(const absl::Status&)>;

  virtual ~MissionStore() = default;

  // Makes a mission without events, durably, and returns its epoch, 1. MISSION_EXISTS if there is
  // one of that key. Blocks.
  virtual absl::StatusOr<std::int64_t> Create(const std::string& key,
                                              const std::string& header) = 0;

  // Takes the mission over, durably. kNotFound; kDataLoss, naming file and record, if it is
  // damaged, or shorter than it is known to have been. Blocks.
  virtual absl::StatusOr<AcquiredMission> Acquire(const std::string& key) = 0;

  // The records from this number on, up to the head as it is now. kNotFound; kOutOfRange, here or
  // from the reader, if that one is not kept any more. Takes nothing over.
  virtual absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string& key,
                                                              std::int64_t first_number) = 0;
  // Header and standing without taking over. kNotFound.
  virtual absl::StatusOr<AcquiredMission> Peek(const std::string& key) = 0;

  // Adds records first_number, first_number + 1 ... after the head; `done` hears once they are
  // durable. Records of one mission become durable in order. While the disk refuses them the store
  // tries again by itself, and `done` waits. An error is final: FENCED if another took the mission
  // over or `first_number` is not the one after the head.
  virtual void Append(const std::string& key, std::int64_t epoch, std::int64_t first_number,
                      std::vector<std::string> records, Done done) = 0;
  // Replaces what is kept beside the events: what operators have done to the mission. As Append.
  virtual void PutStanding(const std::string& key, std::int64_t epoch, std::string standing,
                           Done done) = 0;
  // The newest two are kept. As Append, but on an error of the disk it is not tried again.
  // REQUIRES: snapshot.revision is at most the head.
  virtual void PutSnapshot(const std::string& key, std::int64_t epoch, StoredSnapshot snapshot,
                           Done done) = 0;

  // Records that the older one of two snapshots stands for are gone, durably; none, as long as
  // there are not two that are whole. As PutSnapshot.
  virtual void Trim(const std::string& key, std::int64_t epoch, Done done) = 0;

  // The mission and all that was kept of it are gone, durably. As Append.
  virtual void Remove(const std::string& key, std::int64_t epoch, Done done) = 0;

  // The same of a mission that Acquire calls damaged, whatever is left of it; kFailedPrecondition
  // of one that is whole. MISSION_ELSEWHERE as Acquire.
  virtual void Discard(const std::string& key, Done done) = 0;

  // All missions, by key.
  virtual absl::StatusOr<std::vector<StoredMission>> List() = 0;

  virtual StoreState state() const = 0;
  // Of all files, which it looks at.
  virtual std::int64_t disk_bytes() const { return 0; }
  // Whether what it keeps survives the process.
  virtual bool is_durable() const = 0;
  // The servers that share it; null if it is one server's alone. Then Acquire answers
  // MISSION_ELSEWHERE, naming the node, for a mission of another node that lives.
  virtual StoreNodes* nodes() { return nullptr; }
};

}  // namespace plumescout::server
