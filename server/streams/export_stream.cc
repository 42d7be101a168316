// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/export_stream.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "server/base/grpc_status.h"
#include "server/base/log.h"

namespace plumescout::server {

ExportStream* ExportStream::Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                                  const v1::ExportMissionRequest& request) {
  auto stream = std::make_shared<ExportStream>(context);
  stream->self_ = stream;
  context->streams->Add(stream);
  absl::Status status = stream->visit_.Enter(*context->door, Rpc::kExportMission, *call);
  if (status.ok()) status = stream->Begin(request);
  if (!status.ok()) stream->End(status);
  return stream.get();
}

absl::Status ExportStream::Begin(const v1::ExportMissionRequest& request) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(host_, context_.FindMission(visit_.caller(), mission));
  PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
  const std::weak_ptr<ExportStream> weak = weak_from_this();
  listener_ = host_->end_listeners().Add([weak](const absl::Status& status) {
    if (const auto stream = weak.lock()) stream->End(status);
  });
  // What the mission is now, as soon as that is durable.
  const auto self = shared_from_this();
  return host_->Post(
      [self](MissionWriter& writer) {
        const ExportPoint point{writer.mission().revision(), writer.mission().Digest()};
        self->host_->WhenDurable([self, point](const absl::Status& status) {
          self->BeginAt(status.ok() ? absl::StatusOr<ExportPoint>(point) : status);
        });
      },
      [self](const absl::Status& status) { self->BeginAt(status); });
}

void ExportStream::BeginAt(const absl::StatusOr<ExportPoint>& point) {
  if (!point.ok()) return End(point.status());
  Submit([self = shared_from_this(), point = *point] { self->Open(point); });
}

void ExportStream::Open(const ExportPoint& point) {
  auto opened = MissionExport::Begin(context_.history->store, KeyOf(*host_), point);
  if (!opened.ok()) return End(opened.status());
  export_ = *std::move(opened);
  LogInfo("mission exported", {{"mission", host_->id()},
                               {"revision", absl::StrCat(point.revision)},
                               {"caller", visit_.caller().name},
                               {"request_id", visit_.info().request_id}});
  MakeNext();
}

void ExportStream::MakeNext() {
  {
    absl::MutexLock lock(&mutex_);
    if (end_.has_value()) return;
  }
  auto next = export_->Next();
  if (!next.ok()) return End(next.status());
  if (!next->has_value()) return End(absl::OkStatus());
  message_ = **std::move(next);
  {
    absl::MutexLock lock(&mutex_);
    has_message_ = true;
  }
  Pump();
}

void ExportStream::Submit(std::function<void()> task) {
  const absl::Status queued = context_.query_pool->Submit(std::move(task));
  if (!queued.ok()) End(queued);
}

void ExportStream::End(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    if (!end_.has_value()) end_ = status;
  }
  Pump();
}

void ExportStream::OnWriteDone(bool ok) {
  const auto self = shared_from_this();  // the finish may end us
  {
    absl::MutexLock lock(&mutex_);
    writing_ = false;
    if (!ok && !end_.has_value()) end_ = absl::CancelledError("the stream broke");
  }
  Pump();
  if (ok) Submit([self] { self->MakeNext(); });
}

void ExportStream::OnDone() {
  context_.streams->Remove(this);
  if (host_ != nullptr) host_->end_listeners().Remove(listener_);
  self_.reset();
}

void ExportStream::Pump() {
  const auto self = shared_from_this();  // as above
  pump_.Run(mutex_, [this] {
    mutex_.AssertHeld();
    return NextOperation();
  });
}

StreamPump::Operation ExportStream::NextOperation() {
  if (finished_ || writing_) return nullptr;
  if (end_.has_value()) {
    finished_ = true;
    return [this, status = *end_] {
      visit_.Leave(status);
      Finish(ToGrpc(status, visit_.info().request_id));
    };
  }
  if (!has_message_) return nullptr;
  has_message_ = false;
  writing_ = true;
  return [this] { StartWrite(&message_); };
}

}  // namespace plumescout::server
