// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {

// Errors that all engines of a MissionStore give in the same words.

absl::Status NotStored(absl::string_view key);
absl::Status AlreadyStored(absl::string_view key);
// Somebody who acquired the mission later is writing.
absl::Status FencedByEpoch(absl::string_view key, std::int64_t epoch, std::int64_t newest);
// Another server that shares the store has it and lives; `node` is its name, one word, and the last
// word of the message.
absl::Status MissionElsewhere(absl::string_view key, absl::string_view node);
// The node of a MISSION_ELSEWHERE; nothing for other errors.
absl::string_view NodeElsewhere(const absl::Status& status);
// The key of the mission that one is about; nothing for other errors.
std::string KeyElsewhere(const absl::Status& status);
// Records would leave a gap, or stand twice.
// A mission that had this key before is gone, and another has it.
absl::Status FencedByNamesake(absl::string_view key);
absl::Status FencedByHead(absl::string_view key, std::int64_t first_number, std::int64_t head);
// A snapshot of what is not in the journal yet.
absl::Status SnapshotAhead(absl::string_view key, std::int64_t revision, std::int64_t head);

// Records up to this one were trimmed.
absl::Status NotKept(absl::string_view key, std::int64_t last_gone);
// There is no reason to discard it.
absl::Status NotDamaged(absl::string_view key);
// Records count from 1.
absl::Status BadFirstNumber(std::int64_t first_number);

// What is kept is not what was written; `what` names file and record.
absl::Status StoreDamaged(absl::string_view what);
// The disk does not take or give it now; `what` names the file.
absl::Status StoreUnavailable(absl::string_view what);

}  // namespace plumescout::server
