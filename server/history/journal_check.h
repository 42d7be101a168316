// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "core/types/options.h"
#include "core/types/stop.h"
#include "formats/journal/event_codec.h"

namespace plumescout::server {

// The journal in a file that was found whole.
struct CheckedJournal {
  JournalStart start;
  MissionOptions options;
  std::int64_t events = 0;
};

// Reads an exported mission from its beginning to its end. Errors speak of "the file":
// EXPORT_DAMAGED if it is no journal, damaged, or ends before its last event; kFailedPrecondition
// if it is of a newer format, or no export, which says where it ends; kCancelled. Memory: O(largest
// event).
absl::StatusOr<CheckedJournal> CheckJournal(const std::string& path, const StopFn& stop);

}  // namespace plumescout::server
