// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "client/kept_log.h"
#include "client/log_record.h"
#include "client/log_store.h"
#include "core/types/observation.h"

namespace plumescout::client {

// What has become of a log since the keeper asked last.
struct LogNews {
  std::vector<Renumbering> renumberings;  // since then; the entries have the new numbers
  std::vector<Observation> entries;       // the next that are not on disk yet
  std::int64_t first_held_sequence = 1;
  LogMark mark;
  bool ended = false;  // nothing will be appended any more
};

// The next entries from a number on, at most a few. Waits until there are some, or the log has
// ended, but no longer than `timeout`. A renumbering is told once; `next_sequence` is as of before
// it.
using LogFeed = std::function<LogNews(std::int64_t next_sequence, absl::Duration timeout)>;

struct LogKeeping {
  absl::Duration sync_period;
  absl::Duration retry_period;
};

// Brings a log to disk on a thread of its own, so that nobody waits for the disk. While that is
// full or fails the log lives on in memory, and is written from there once the disk takes it; what
// memory had to drop until then is missing on disk.
class LogKeeper {
 public:
  // `on_disk`, told on the keeper's thread: why the disk fails when it begins to; OK once it takes
  // the log again. May be empty. `next_sequence`: of the first entry that the store does not have.
  LogKeeper(std::unique_ptr<LogStore> store, std::int64_t next_sequence, const LogKeeping& keeping,
            LogFeed feed, std::function<void(const absl::Status&)> on_disk);
  // Waits until the log has ended, and all of it is written and synced, if the disk takes it.
  ~LogKeeper();
  LogKeeper(const LogKeeper&) = delete;
  LogKeeper& operator=(const LogKeeper&) = delete;

 private:
  void Run();
  absl::Duration Patience() const;
  void Follow(const LogNews& news);
  absl::Status Write(const LogNews& news);
  absl::Status Sync(const LogMark& mark);
  void NoteDisk(const absl::Status& status);
  void Rewind();

  const std::unique_ptr<LogStore> store_;
  const LogKeeping keeping_;
  const LogFeed feed_;
  const std::function<void(const absl::Status&)> on_disk_;

  // Of the thread alone. Numbers are as of the last renumbering that was heard of.
  std::int64_t next_sequence_;                 // to write
  std::int64_t synced_sequence_;               // what stands before is on disk for good
  std::vector<NumberedRenumbering> owed_;      // to be written before anything else
  std::vector<NumberedRenumbering> unsynced_;  // written
  std::int64_t renumberings_;                  // heard of
  LogMark mark_;                               // as written
  bool dirty_ = false;
  absl::Time last_sync_;
  int failed_syncs_ = 0;
  absl::Status disk_;

  std::thread thread_;  // last: it uses everything above
};

}  // namespace plumescout::client
