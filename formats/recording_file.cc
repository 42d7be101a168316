// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/recording_file.h"

#include <filesystem>
#include <memory>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/append_file.h"
#include "formats/file_io.h"

namespace plumescout {
namespace {

// What was recorded may have been made anew, under the same name.
constexpr int kMostFilesOfAName = 1000;

}  // namespace

absl::StatusOr<AppendBytes> OpenRecordingFile(const std::string& path) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(std::filesystem::path(path).parent_path().string()));
  PLUMESCOUT_ASSIGN_OR_RETURN(AppendFile file, AppendFile::Create(path));
  return AppendBytes([file = std::make_shared<AppendFile>(std::move(file))](
                         absl::string_view bytes) { return file->Append(bytes); });
}

absl::Status RecordingFile::Begin(const std::string& stem) {
  absl::StatusOr<AppendBytes> opened = absl::AlreadyExistsError("");
  for (int i = 1; i <= kMostFilesOfAName && absl::IsAlreadyExists(opened.status()); ++i) {
    path_ = absl::StrCat(stem, i == 1 ? "" : absl::StrCat("-", i), ".mcap");
    opened = options_.open(path_);
  }
  PLUMESCOUT_RETURN_IF_ERROR(opened.status());
  append_ = *std::move(opened);
  file_bytes_ = 0;
  return absl::OkStatus();
}

absl::Status RecordingFile::Append(absl::string_view bytes) {
  if (bytes.empty()) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(append_(bytes));
  file_bytes_ += static_cast<std::int64_t>(bytes.size());
  NoteChunk();
  return absl::OkStatus();
}

void RecordingFile::NoteMessage(Time now) {
  if (chunk_end_ == Time::max())
    chunk_end_ = now + absl::ToChronoNanoseconds(options_.chunk_period);
}

void RecordingFile::End() {
  append_ = nullptr;
  NoteChunk();
}

void RecordingFile::GiveUp(Time now) {
  End();
  retry_at_ = now + absl::ToChronoNanoseconds(options_.retry_after);
}

}  // namespace plumescout
