// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/journal_check.h"

#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"
#include "formats/journal/journal_file.h"
#include "server/missions/mission_recovery.h"

namespace plumescout::server {
namespace {

// Of the path of a file put aside the caller knows nothing.
std::string WithoutPath(absl::string_view message, const std::string& path) {
  return absl::StrReplaceAll(message, {{path, "the file"}});
}

absl::Status DamagedExport(absl::string_view message) {
  return TypedError(absl::StatusCode::kInvalidArgument, reason::kExportDamaged, message);
}

// A file of another format is sound, but not for this program.
absl::Status OfTheFile(const absl::Status& status, const std::string& path) {
  const std::string message = WithoutPath(status.message(), path);
  if (absl::IsInvalidArgument(status)) return absl::FailedPreconditionError(message);
  if (absl::IsDataLoss(status)) return DamagedExport(message);
  return {status.code(), message};
}

absl::Status IsCutOff(std::int64_t events, std::int64_t last_number, absl::string_view torn) {
  return DamagedExport(absl::StrCat("the file ends after event ", events, " of ", last_number,
                                    torn.empty() ? "" : ": ", torn));
}

}  // namespace

absl::StatusOr<CheckedJournal> CheckJournal(const std::string& path, const StopFn& stop) {
  auto reader = JournalFileReader::Open(path);
  if (!reader.ok()) return OfTheFile(reader.status(), path);
  if (!reader->start().has_value() || reader->start()->mission.empty()) {
    return absl::FailedPreconditionError("the file is a recording, not an exported mission");
  }
  CheckedJournal journal;
  journal.start = *reader->start();
  const auto options = OptionsOf(journal.start);
  if (!options.ok()) return DamagedExport(options.status().message());
  journal.options = *options;
  for (;;) {
    if (stop()) return absl::CancelledError("the import was given up");
    const absl::StatusOr<std::optional<Event>> event = reader->Next();
    if (!event.ok()) return OfTheFile(event.status(), path);
    if (!event->has_value()) break;
    if ((*event)->number != ++journal.events) {
      return DamagedExport(absl::StrCat("the file has event ", (*event)->number,
                                        " in the place of ", journal.events));
    }
  }
  if (journal.events != journal.start.last_number || !reader->torn_end().empty()) {
    return IsCutOff(journal.events, journal.start.last_number,
                    WithoutPath(reader->torn_end(), path));
  }
  return journal;
}

}  // namespace plumescout::server
