// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_recording.h"

#include <filesystem>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/append_file.h"
#include "formats/file_io.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

// Of one mission that begin with the same event: it was made anew, or the server did not store it.
constexpr int kMostFilesOfAName = 1000;

}  // namespace

absl::StatusOr<AppendBytes> OpenRecordingFile(const std::string& path) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(std::filesystem::path(path).parent_path().string()));
  PLUMESCOUT_ASSIGN_OR_RETURN(AppendFile file, AppendFile::Create(path));
  return AppendBytes([file = std::make_shared<AppendFile>(std::move(file))](
                         absl::string_view bytes) { return file->Append(bytes); });
}

MissionRecording::MissionRecording(const JournalStart& start, std::string key,
                                   RecordingOptions options, MissionMetrics* metrics)
    : start_(start), key_(std::move(key)), options_(std::move(options)), metrics_(*metrics) {}

void MissionRecording::Add(MissionMoment moment, std::int64_t missing, SteadyTime now) {
  missing_events_ += missing;
  if (!view_ && now < retry_at_) {
    ++missing_events_;
    return metrics_.NoteRecordingDrop();
  }
  absl::Status status = view_ ? absl::OkStatus() : Begin(moment.event.number);
  if (status.ok()) status = Show(std::move(moment));
  if (!status.ok()) {
    ++missing_events_;
    metrics_.NoteRecordingDrop();
    return Fail(status, now);
  }
  if (chunk_end_ == SteadyTime::max()) chunk_end_ = After(now, options_.chunk_period);
  if (file_bytes_ >= options_.max_file_bytes) Finish(nullptr, now);
}

absl::Status MissionRecording::Begin(std::int64_t event) {
  absl::StatusOr<AppendBytes> opened = absl::AlreadyExistsError("");
  for (int i = 1; i <= kMostFilesOfAName && absl::IsAlreadyExists(opened.status()); ++i) {
    path_ = absl::StrCat(options_.folder, "/", key_, ".", event, i == 1 ? "" : absl::StrCat("-", i),
                         ".mcap");
    opened = options_.open(path_);
  }
  PLUMESCOUT_RETURN_IF_ERROR(opened.status());
  append_ = *std::move(opened);
  view_.emplace(start_);
  file_bytes_ = 0;
  LogInfo("mission is recorded", {{"mission", key_}, {"file", path_}});
  return Write();
}

absl::Status MissionRecording::Show(MissionMoment moment) {
  const std::int64_t number = moment.event.number;
  moment.record = EncodeEvent(moment.event, PlanDetail::kForReplay);
  PLUMESCOUT_RETURN_IF_ERROR(view_->Add(std::move(moment)));
  if (missing_events_ > 0) {
    PLUMESCOUT_RETURN_IF_ERROR(view_->NoteGap(std::exchange(missing_events_, 0), number));
  }
  return Write();
}

absl::Status MissionRecording::Write() {
  if (view_->ready_bytes() == 0) return absl::OkStatus();
  const std::string bytes = view_->Take();
  PLUMESCOUT_RETURN_IF_ERROR(append_(bytes));
  file_bytes_ += std::ssize(bytes);
  metrics_.NoteRecordedBytes(std::ssize(bytes));
  chunk_end_ = SteadyTime::max();
  return absl::OkStatus();
}

void MissionRecording::EndChunkIfDue(SteadyTime now) {
  if (!view_ || now < chunk_end_) return;
  absl::Status status = view_->EndChunk();
  if (status.ok()) status = Write();
  if (!status.ok()) return Fail(status, now);
  chunk_end_ = SteadyTime::max();
}

void MissionRecording::Finish(const std::shared_ptr<const Belief>& belief, SteadyTime now) {
  if (!view_) return;
  absl::Status status = view_->Finish(belief);
  if (status.ok()) status = Write();
  if (!status.ok()) return Fail(status, now);
  view_.reset();
  append_ = nullptr;
}

void MissionRecording::Fail(const absl::Status& why, SteadyTime now) {
  view_.reset();
  append_ = nullptr;
  chunk_end_ = SteadyTime::max();
  retry_at_ = After(now, options_.retry_after);
  metrics_.NoteRecordingFailure();
  LogWarning("recording stops, and the mission goes on without",
             {{"mission", key_},
              {"file", path_},
              {"why", std::string(why.message())},
              {"next_try_in_s", absl::StrCat(absl::ToDoubleSeconds(options_.retry_after))}});
}

}  // namespace plumescout::server
