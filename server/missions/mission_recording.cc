// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_recording.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/base/log.h"

namespace plumescout::server {

MissionRecording::MissionRecording(const JournalStart& start, std::string key,
                                   const RecordingOptions& options, MissionMetrics* metrics)
    : start_(start),
      key_(std::move(key)),
      folder_(options.folder),
      map_share_(options.map_share),
      metrics_(*metrics),
      file_(options.file) {}

void MissionRecording::Add(MissionMoment moment, std::int64_t missing, SteadyTime now) {
  missing_events_ += missing;
  if (!view_ && file_.rests(now)) {
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
  file_.NoteMessage(now);
  if (file_.is_full()) Finish(nullptr, now);
}

absl::Status MissionRecording::Begin(std::int64_t event) {
  PLUMESCOUT_RETURN_IF_ERROR(file_.Begin(absl::StrCat(folder_, "/", key_, ".", event)));
  view_.emplace(start_, map_share_);
  LogInfo("mission is recorded", {{"mission", key_}, {"file", file_.path()}});
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
  const std::string bytes = view_->Take();
  PLUMESCOUT_RETURN_IF_ERROR(file_.Append(bytes));
  metrics_.NoteRecordedBytes(std::ssize(bytes));
  return absl::OkStatus();
}

void MissionRecording::EndChunkIfDue(SteadyTime now) {
  if (!view_ || !file_.IsChunkDue(now)) return;
  absl::Status status = view_->EndChunk();
  if (status.ok()) status = Write();
  if (!status.ok()) return Fail(status, now);
  file_.NoteChunk();
}

void MissionRecording::Finish(const std::shared_ptr<const Belief>& belief, SteadyTime now) {
  if (!view_) return;
  absl::Status status = view_->Finish(belief);
  if (status.ok()) status = Write();
  if (!status.ok()) return Fail(status, now);
  view_.reset();
  file_.End();
}

void MissionRecording::Fail(const absl::Status& why, SteadyTime now) {
  view_.reset();
  file_.GiveUp(now);
  metrics_.NoteRecordingFailure();
  LogWarning("recording stops, and the mission goes on without",
             {{"mission", key_},
              {"file", file_.path()},
              {"why", std::string(why.message())},
              {"next_try_in_s", absl::StrCat(absl::ToDoubleSeconds(file_.retry_after()))}});
}

}  // namespace plumescout::server
