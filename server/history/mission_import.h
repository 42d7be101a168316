// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/types/stop.h"
#include "formats/file_sum.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/history/journal_check.h"
#include "server/history/spool_file.h"
#include "server/missions/mission_host.h"
#include "server/missions/mission_registry.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

struct ImportLimits {
  std::int64_t max_bytes = std::int64_t{4} << 30;  // of a file
  int max_at_once = 2;
  std::string folder = {};  // for files that come; empty: the system's
};

// For whom the mission is made, and under which name; empty: that in the file.
struct ImportWish {
  MissionId mission;
  MissionOwner owner;
};

// One mission on its way in: its file is put aside as it comes, then checked as a whole, and only
// then does the store hear of it. If the process dies before the last event is there, the next one
// removes what there is (DropUnfinishedImports). Single-threaded; calls block.
class MissionImport {
 public:
  // `place` is let go with the import.
  MissionImport(MissionStore& store, MissionRegistry& registry, const ImportLimits& limits,
                SpoolFile file, std::shared_ptr<void> place)
      : store_(store),
        registry_(registry),
        limits_(limits),
        file_(std::move(file)),
        place_(std::move(place)) {}

  // kInvalidArgument naming the field if the piece is not what was sent, or does not follow on the
  // last; LIMIT_REACHED.
  absl::Status Add(const v1::MissionFilePiece& piece);

  // The mission, recovered from the store. kInvalidArgument naming the field if the file is not
  // what was sent, EXPORT_DAMAGED if it was not whole when it was; kFailedPrecondition if it is no
  // export, or of a newer format; kDataLoss if its events make another mission than that which was
  // exported; MISSION_EXISTS; LIMIT_REACHED; kInvalidArgument naming an option that this server
  // does not allow; kCancelled. After an error nothing is left of it. Takes as long as the
  // mission's events took the server that had them.
  absl::StatusOr<std::shared_ptr<MissionHost>> Finish(const v1::MissionFileEnd& end,
                                                      const ImportWish& wish, const StopFn& stop);

 private:
  absl::Status CheckEnd(const v1::MissionFileEnd& end);
  absl::Status Store(const CheckedJournal& journal, const std::string& key, const ImportWish& wish,
                     const StopFn& stop);
  void Remove(const std::string& key, std::int64_t epoch);
  absl::Status Fill(const std::string& key, std::int64_t epoch, const StopFn& stop);
  absl::StatusOr<std::shared_ptr<MissionHost>> Revive(const CheckedJournal& journal,
                                                      const std::string& key,
                                                      const ImportWish& wish, const StopFn& stop);

  MissionStore& store_;
  MissionRegistry& registry_;
  const ImportLimits limits_;
  SpoolFile file_;
  const std::shared_ptr<void> place_;
  FileSum sum_;
};

// Removes what imports have left in the store that a crash cut short. Before missions are
// recovered.
absl::Status DropUnfinishedImports(MissionStore& store);

}  // namespace plumescout::server
