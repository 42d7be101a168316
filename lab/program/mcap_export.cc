// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/mcap_export.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/view/mission_mcap.h"

namespace plumescout::lab {
namespace {

absl::Status Write(Recording& recording, MissionMcap& mcap, std::ostream& file,
                   const std::function<void(double)>& progress) {
  while (file) {
    if (progress) progress(recording.share_read());
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<Event> event, recording.Next());
    if (!event) break;
    PLUMESCOUT_RETURN_IF_ERROR(mcap.Add(*event, EncodeEvent(*event)));
    file << mcap.Take();
  }
  PLUMESCOUT_RETURN_IF_ERROR(mcap.Finish());
  file << mcap.Take() << std::flush;
  return file ? absl::OkStatus() : absl::UnavailableError("could not be written");
}

}  // namespace

absl::Status ExportMcap(Recording& recording, const std::string& path, double map_period_s,
                        double map_share, const std::function<void(double)>& progress) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<Mission> mission,
                              Mission::Create(recording.options()));
  MissionMcap mcap(recording.start(), std::move(mission), map_period_s, map_share);
  const std::string part = absl::StrCat(path, ".part");
  std::ofstream file(part, std::ios::binary);
  absl::Status status = Write(recording, mcap, file, progress);
  file.close();
  std::error_code error;
  if (status.ok()) std::filesystem::rename(part, path, error);
  if (status.ok() && !error) return status;
  if (status.ok()) status = absl::UnavailableError(error.message());
  std::filesystem::remove(part, error);
  return absl::Status(status.code(), absl::StrCat(path, ": ", status.message()));
}

}  // namespace plumescout::lab
