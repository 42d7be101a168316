// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

inline constexpr int kKeptSnapshots = 2;  // of a mission, the newest

// Something to be written, and what came of it.
struct StoreWrite {
  enum class Kind {
    kCreate,
    kUndoCreate,  // of a mission whose Create was answered with an error, but may have been written
    kAcquire,
    kAppend,
    kStanding,
    kSnapshot,
    kTrim,
    kRemove,
    kDiscard,
    kCompact  // a bounded step
  };

  Kind kind = Kind::kAppend;
  std::string key;
  std::int64_t epoch = 0;            // of who writes
  std::int64_t first_number = 0;     // kAppend
  std::vector<std::string> records;  // kAppend
  std::string bytes;                 // kCreate, kUndoCreate: the header; kStanding
  StoredSnapshot snapshot;           // kSnapshot
  MissionStore::Done done;           // may be empty

  // A commit of this failed, so it may have been written already.
  bool tried = false;

  // By the engine, in each attempt.
  absl::Status result;
  bool inserted = false;                // kCreate: the mission was not there before
  AcquiredMission* acquired = nullptr;  // kAcquire: filled in, if not null
  std::int64_t* left = nullptr;         // kCompact: pages that are still to be freed, if not null

  // Answered with an error when the disk refuses it, instead of being tried again.
  bool is_impatient() const {
    return kind == Kind::kCreate || kind == Kind::kAcquire || kind == Kind::kSnapshot ||
           kind == Kind::kTrim || kind == Kind::kCompact;
  }
  std::int64_t payload_bytes() const {
    std::size_t sum = bytes.size() + snapshot.bytes.size();
    for (const std::string& record : records) sum += record.size();
    return static_cast<std::int64_t>(sum);
  }
};

// What a Committer writes to. Used by its thread only.
class WriteEngine {
 public:
  virtual ~WriteEngine() = default;

  // Writes all of them, durably and in order, or nothing. OK: each has its `result`, and one that
  // has an error has changed nothing. Nothing to write: sees whether the disk takes something, or
  // does one of the chores.
  //
  // Errors: kUnavailable if it may work later (then it is uncertain whether they were written);
  // others do not go away by themselves.
  virtual absl::Status Commit(std::span<StoreWrite> writes) = 0;

  // What need not be done before callers hear of a commit.
  virtual void Tidy() {}
  // Whether there is work for when nobody writes.
  virtual bool has_chores() const { return false; }
};

}  // namespace plumescout::server
