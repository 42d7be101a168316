// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/event.h"
#include "formats/journal/event_codec.h"

namespace plumescout {

// Bodies in files of versions 3 and 4 (journal_file.h), which are no longer written: little-endian
// numbers of fixed width, lists and texts behind a 32-bit length, fields in the order of their
// declaration then; robots had no log_epoch.
//
// kDataLoss and memory as of DecodeEvent.
absl::StatusOr<Event> DecodeEventV4(absl::string_view bytes);

// Likewise. There were a code version and the mission's options.
absl::StatusOr<JournalStart> DecodeStartV4(absl::string_view bytes);

}  // namespace plumescout
