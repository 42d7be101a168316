// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_recording.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/types/status_macros.h"

namespace plumescout::client {

RobotRecording::RobotRecording(const RobotRecordingOptions& options,
                               const Participation& participation, std::int64_t time_ns)
    : options_(options), participation_(participation), time_ns_(time_ns), file_(options.file) {}

void RobotRecording::Add(const RobotNews& news, std::int64_t missing, RecordingFile::Time now) {
  missing_ += missing;
  if (!view_ && file_.rests(now)) {
    ++missing_;
    return;
  }
  absl::Status status = view_ ? absl::OkStatus() : Begin();
  if (status.ok()) status = Show(news);
  if (!status.ok()) {
    ++missing_;
    return Fail(status, now);
  }
  file_.NoteMessage(now);
  if (file_.is_full()) Finish(/*missing=*/0, now);
}

absl::Status RobotRecording::Begin() {
  const std::string time = absl::FormatTime("%Y%m%dT%H%M%SZ", absl::Now(), absl::UTCTimeZone());
  PLUMESCOUT_RETURN_IF_ERROR(file_.Begin(absl::StrCat(options_.folder, "/", participation_.mission,
                                                      "/", participation_.robot, ".", time)));
  view_.emplace(participation_, time_ns_);
  Say(absl::StrCat("recorded in ", file_.path()));
  return Write();
}

absl::Status RobotRecording::Show(const RobotNews& news) {
  PLUMESCOUT_RETURN_IF_ERROR(NoteMissing());
  PLUMESCOUT_RETURN_IF_ERROR(view_->Add(news));
  return Write();
}

absl::Status RobotRecording::NoteMissing() {
  return missing_ > 0 ? view_->NoteGap(std::exchange(missing_, 0)) : absl::OkStatus();
}

void RobotRecording::EndChunkIfDue(RecordingFile::Time now) {
  if (!view_ || !file_.IsChunkDue(now)) return;
  absl::Status status = view_->EndChunk();
  if (status.ok()) status = Write();
  if (!status.ok()) return Fail(status, now);
  file_.NoteChunk();
}

void RobotRecording::Finish(std::int64_t missing, RecordingFile::Time now) {
  if (!view_) return;
  missing_ += missing;
  absl::Status status = NoteMissing();
  if (status.ok()) status = view_->Finish();
  if (status.ok()) status = Write();
  if (!status.ok()) return Fail(status, now);
  Leave();
  file_.End();
}

void RobotRecording::Fail(const absl::Status& why, RecordingFile::Time now) {
  Leave();
  file_.GiveUp(now);
  Say(absl::StrCat("recording stops, and the robot goes on without: ", why.message(),
                   "; next try in ", absl::FormatDuration(file_.retry_after())));
}

void RobotRecording::Leave() {
  if (view_) time_ns_ = view_->now_ns();
  view_.reset();
}

}  // namespace plumescout::client
