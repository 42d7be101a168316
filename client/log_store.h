// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/folder_lock.h"
#include "client/kept_log.h"
#include "client/log_record.h"
#include "client/segment_file.h"
#include "core/types/ids.h"
#include "core/types/observation.h"

namespace plumescout::client {

struct LogStoreOptions {
  std::string folder;  // empty: the log is in memory alone
  std::size_t segment_bytes = std::size_t{4} << 20;
  // How often what was written is synced, if anything was. What is older survives the loss of
  // power. 0: at once; infinite: at the end alone.
  absl::Duration sync_period = absl::Milliseconds(200);
  absl::Duration retry_period = absl::Seconds(1);  // of a disk that is full or fails
};

// A robot's log on disk: segments log-00000001, log-00000002 ... in a folder of its own. They are
// only appended to; whole segments go once nothing in them is needed. Not thread-safe.
//
// After an error the store holds what it held before, and the same call may be made again. But if a
// sync was what failed, nobody knows what of the records since the sync before it is on disk: all
// of them have to be appended again. Those that are there already do no harm.
class LogStore {
 public:
  struct Segment {
    std::string path;
    std::int64_t last_sequence = 0;  // of its entries, or more
  };

  // Takes up a log after its last segment. For OpenLog.
  LogStore(const LogStoreOptions& options, const LogSystem& system, FolderLock lock,
           SegmentHead head, std::vector<Segment> segments, std::int64_t next_segment);

  absl::Status Append(const Observation& observation);
  // All that was appended before has other numbers. Told again under the same number, it is known.
  absl::Status Append(const NumberedRenumbering& numbered);
  absl::Status Append(const LogMark& mark);

  absl::Status Sync();

  // Entries before this one are not needed any more.
  void DropBefore(std::int64_t sequence);

  std::int64_t renumberings() const { return head_.renumberings; }
  int failed_syncs() const { return failed_syncs_; }

 private:
  absl::Status Write(const LogRecord& record);
  absl::Status BeginSegment();
  void EndSegment();
  // The current segment is given up: what of it is on disk, nobody knows.
  void Abandon();

  const LogStoreOptions options_;
  const LogSystem system_;
  const FolderLock lock_;
  SegmentHead head_;                   // as the log stands
  SegmentHead synced_head_;            // as it stood at the last sync
  std::int64_t applied_renumberings_;  // of the segments' last numbers
  std::deque<Segment> older_;
  std::int64_t next_segment_;
  int failed_syncs_ = 0;
  std::unique_ptr<SegmentFile> current_;  // none before the first record
};

struct OpenedLog {
  KeptLog log;
  std::unique_ptr<LogStore> store;
  std::vector<absl::Status> damage;  // each names the file, and what of it was left out
};

// Opens the log in a folder, or begins one there with `new_epoch`. A record that was not written to
// its end, the last of all, is cut off; what else is damaged is named, and what can be read before
// and after it is kept.
//
// Errors, with which nothing has changed: kFailedPrecondition if another process has the folder, or
// if it holds the log of another robot or mission, or of a later version; kUnavailable if the
// system refuses.
absl::StatusOr<OpenedLog> OpenLog(const LogStoreOptions& options, const MissionId& mission,
                                  const RobotId& robot, std::int64_t new_epoch,
                                  const LogSystem& system = {});

}  // namespace plumescout::client
