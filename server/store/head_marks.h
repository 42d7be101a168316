// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

inline constexpr std::size_t kMaxMissionKeyBytes = 216;

// How far a mission was written at least.
struct HeadMark {
  std::string key;
  std::int64_t epoch = 0;
  std::int64_t head = 0;
  std::uint32_t chain = 0;  // checksum of all records up to the head
  std::int64_t writes = 0;  // of whatever is kept of it

  friend bool operator==(const HeadMark&, const HeadMark&) = default;
};

// What a file of marks tells of a mission.
struct KnownHead {
  std::string file;
  std::optional<HeadMark> mark;
};

struct HeadMarkList {
  struct Placed {
    std::size_t slot = 0;
    HeadMark mark;
  };

  std::vector<Placed> marks;
  std::vector<std::size_t> free_slots;
  std::vector<std::size_t> damaged_slots;
  std::size_t slots = 0;
};

// What the file says; nothing if there is none. kUnavailable.
absl::StatusOr<HeadMarkList> ReadHeadMarks(const std::string& path);

// A file that tells, beside the database, how far each mission was written: a database that has
// lost its end, or is an old copy, is still a whole one in itself. It has a slot for each mission,
// written after every commit and left to the system to bring to the disk, so it never tells of more
// than the database had durably. Thread-safe.
class HeadMarks {
 public:
  // Slots that are damaged tell nothing, and are used again.
  static absl::StatusOr<std::unique_ptr<HeadMarks>> Open(const std::string& path);
  // Nothing of it may be changed then.
  static absl::StatusOr<std::unique_ptr<const HeadMarks>> OpenToRead(const std::string& path);
  ~HeadMarks();
  HeadMarks(const HeadMarks&) = delete;
  HeadMarks& operator=(const HeadMarks&) = delete;

  const std::string& path() const { return path_; }
  // Found when it was opened.
  std::size_t damaged_slots() const { return damaged_slots_; }

  std::optional<HeadMark> Find(const std::string& key) const;
  KnownHead Known(const std::string& key) const { return {path_, Find(key)}; }
  std::vector<HeadMark> All() const;

  // Errors: kUnavailable; then the older mark may stand.
  absl::Status Set(const HeadMark& mark);
  // Durably, for whoever removes the mission next. OK if there is none.
  absl::Status Clear(const std::string& key);

 private:
  HeadMarks(std::string path, int descriptor, const HeadMarkList& list);
  absl::Status Write(std::size_t slot, const std::string& bytes)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const std::string path_;
  const int descriptor_;  // -1: to read only
  const std::size_t damaged_slots_;

  mutable absl::Mutex mutex_;
  std::map<std::string, HeadMarkList::Placed> placed_ ABSL_GUARDED_BY(mutex_);
  std::vector<std::size_t> free_ ABSL_GUARDED_BY(mutex_);
  std::size_t end_ ABSL_GUARDED_BY(mutex_);  // slots in the file
};

}  // namespace plumescout::server
