// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/import_stream.h"

#include <chrono>

#include "absl/strings/str_cat.h"
#include "core/types/ids.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/base/grpc_status.h"
#include "server/base/log.h"

namespace plumescout::server {

ImportStream* ImportStream::Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                                  v1::ImportMissionResponse* response, Describe describe) {
  auto stream = std::make_shared<ImportStream>(context, response, std::move(describe));
  stream->self_ = stream;
  context->streams->Add(stream);
  absl::Status status = stream->visit_.Enter(*context->door, Rpc::kImportMission, *call);
  context->streams->LetIn(stream.get(), stream->visit_.info().recheck);
  if (status.ok()) status = context->CheckKeepsHistory();
  if (!status.ok()) stream->End(status);
  stream->Pump();
  return stream.get();
}

void ImportStream::End(const absl::Status& status) {
  stopped_ = true;
  {
    absl::MutexLock lock(&mutex_);
    if (!end_.has_value()) end_ = status;
  }
  Pump();
}

void ImportStream::OnReadDone(bool ok) {
  std::unique_ptr<grpc::Alarm> alarm;  // not let go under the lock
  bool is_part = false;
  {
    absl::MutexLock lock(&mutex_);
    alarm.swap(alarm_);
    reading_ = false;
    if (!ok && !end_.has_value()) {
      end_ = FieldError("end", "must be the last part: the file is not whole");
    }
    is_part = handling_ = !end_.has_value();
  }
  if (is_part) {
    const absl::Status queued =
        context_.history->imports.pool().Submit([self = shared_from_this()] { self->Handle(); });
    if (queued.ok()) return;
    absl::MutexLock lock(&mutex_);
    handling_ = false;
    if (!end_.has_value()) end_ = queued;
  }
  Pump();
}

void ImportStream::Handle() {
  const absl::Status status = stopped_ ? absl::OkStatus() : HandlePart();
  {
    absl::MutexLock lock(&mutex_);
    handling_ = false;
    if (!status.ok() && !end_.has_value()) end_ = status;
  }
  Pump();
}

absl::Status ImportStream::HandlePart() {
  switch (request_.part_case()) {
    case v1::ImportMissionRequest::kStart:
      return Open(request_.start());
    case v1::ImportMissionRequest::kPiece:
      if (import_ == nullptr) return FieldError("start", "must be the first part");
      return import_->Add(request_.piece());
    case v1::ImportMissionRequest::kEnd:
      if (import_ == nullptr) return FieldError("start", "must be the first part");
      return Conclude(request_.end());
    case v1::ImportMissionRequest::PART_NOT_SET:
      break;
  }
  return FieldError("part", "must be one of start, piece, end");
}

absl::Status ImportStream::Open(const v1::ImportStart& start) {
  if (import_ != nullptr) return FieldError("start", "must come once, as the first part");
  wish_ = {start.mission_id(), {visit_.caller().name, visit_.caller().tenant}};
  if (!wish_.mission.empty()) {
    PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("start.mission_id", wish_.mission), ""));
    // It would be said at the end too, but then the file has come for nothing.
    if (context_.registry->Find(wish_.mission, wish_.owner.tenant).ok()) {
      return MissionExists(wish_.mission);
    }
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(import_, context_.history->imports.Open());
  return absl::OkStatus();
}

absl::Status ImportStream::Conclude(const v1::MissionFileEnd& end) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host,
                              import_->Finish(end, wish_, [this] { return stopped_.load(); }));
  *response_->mutable_mission() = describe_(*host);
  LogInfo("mission imported", {{"mission", host->id()},
                               {"revision", absl::StrCat(host->summary().revision)},
                               {"caller", visit_.caller().name},
                               {"request_id", visit_.info().request_id}});
  absl::MutexLock lock(&mutex_);
  if (!end_.has_value()) end_ = absl::OkStatus();
  return absl::OkStatus();
}

void ImportStream::SetAlarm() {
  const absl::Duration patience = context_.limits.import_patience;
  auto alarm = std::make_unique<grpc::Alarm>();
  alarm->Set(std::chrono::system_clock::now() + absl::ToChronoMicroseconds(patience),
             [weak = weak_from_this(), patience](bool is_due) {
               const auto self = weak.lock();
               if (!is_due || self == nullptr) return;
               self->End(absl::DeadlineExceededError(
                   absl::StrCat("nothing came for ", absl::FormatDuration(patience))));
             });
  absl::MutexLock lock(&mutex_);
  if (reading_) alarm_ = std::move(alarm);
}

void ImportStream::OnDone() {
  context_.streams->Remove(this);
  std::unique_ptr<grpc::Alarm> alarm;
  {
    absl::MutexLock lock(&mutex_);
    alarm.swap(alarm_);
  }
  self_.reset();
}

void ImportStream::Pump() {
  const auto self = shared_from_this();  // the finish may end us
  pump_.Run(mutex_, [this] {
    mutex_.AssertHeld();
    return NextOperation();
  });
}

StreamPump::Operation ImportStream::NextOperation() {
  if (finished_ || handling_) return nullptr;
  if (end_.has_value()) {
    finished_ = true;
    return
        [this, status = *end_] { Finish(ToGrpc(visit_.Leave(status), visit_.info().request_id)); };
  }
  if (reading_) return nullptr;
  reading_ = true;
  return [this] {
    SetAlarm();
    StartRead(&request_);
  };
}

}  // namespace plumescout::server
