// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/export_stream.h"

#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "server/base/log.h"
#include "server/calls/unary_call.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kPoolRetry = absl::Milliseconds(50);

}  // namespace

ExportStream* ExportStream::Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                                  const v1::ExportMissionRequest& request) {
  const auto stream = std::make_shared<ExportStream>(context);
  stream->Run(Rpc::kExportMission, *call, [stream, &request] { return stream->Begin(request); });
  return stream.get();
}

absl::Status ExportStream::Begin(const v1::ExportMissionRequest& request) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  if (!v1::MissionFileFormat_IsValid(request.format())) {
    return FieldError("format", request.format(), "is unknown");
  }
  as_mcap_ = request.format() == v1::MISSION_FILE_FORMAT_MCAP;
  PLUMESCOUT_ASSIGN_OR_RETURN(host_, context_.FindMission(visit_.caller(), mission));
  PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
  listener_ = host_->end_listeners().Add([weak = weak_from_this()](const absl::Status& status) {
    if (const auto stream = weak.lock()) stream->End(status);
  });
  // What the mission is now, as soon as that is durable.
  const auto self = shared_from_this();
  return host_->Post(
      [this, self](MissionWriter& writer) {
        const ExportPoint point{writer.mission().revision(), writer.mission().Digest()};
        host_->WhenDurable([this, self, point](const absl::Status& status) {
          BeginAt(status.ok() ? absl::StatusOr<ExportPoint>(point) : status);
        });
      },
      [self](const absl::Status& status) { self->End(status); });
}

void ExportStream::BeginAt(const absl::StatusOr<ExportPoint>& point) {
  if (!point.ok()) return End(point.status());
  const absl::Status queued = Submit([this, point = *point] { Open(point); });
  if (!queued.ok()) End(queued);
}

absl::Status ExportStream::Submit(std::function<void()> task) {
  return context_.past_pool->Submit(
      TurnOf(visit_.info(), host_->id()),
      {[self = shared_from_this(), task = std::move(task)] { task(); }});
}

void ExportStream::Open(const ExportPoint& point) {
  MissionExport::MakePast make_past;
  if (as_mcap_) {
    make_past = [this] {
      const StopFn stop = [weak = weak_from_this()] {
        const auto self = weak.lock();
        return self == nullptr || static_cast<ExportStream&>(*self).HasEnded();
      };
      return context_.history->past_missions.Make(*host_, 0, "mission", PastUse::kExport, stop);
    };
  }
  auto opened = MissionExport::Begin(context_.history->store, KeyOf(*host_), point, make_past);
  if (!opened.ok()) return End(opened.status());
  export_ = *std::move(opened);
  LogInfo("mission exported", {{"mission", host_->id()},
                               {"revision", absl::StrCat(point.revision)},
                               {"caller", visit_.caller().name},
                               {"request_id", visit_.info().request_id}});
  MakeNext();
}

void ExportStream::MakeNext() {
  if (HasEnded()) return;
  auto next = export_->Next();
  if (!next.ok()) return End(next.status());
  if (!next->has_value()) return End(absl::OkStatus());
  if ((*next)->part_case() == v1::ExportMissionResponse::PART_NOT_SET) {
    return SubmitNext();
  }
  message_ = **std::move(next);
  {
    absl::MutexLock lock(&mutex_);
    making_ = false;
    has_message_ = true;
  }
  Pump();
}

void ExportStream::SubmitNext() {
  if (HasEnded()) return;
  const absl::Status queued = Submit([this] { MakeNext(); });
  if (queued.ok()) return room_by_.reset();
  if (!room_by_) room_by_ = After(SteadyNow(), context_.limits.export_patience);
  if (SteadyNow() >= *room_by_) return End(queued);
  SetAlarm(kPoolRetry, [](ExportStream& self) { self.SubmitNext(); });
}

void ExportStream::SetAlarm(absl::Duration wait, std::function<void(ExportStream&)> ring) {
  auto alarm = std::make_unique<grpc::Alarm>();
  alarm->Set(std::chrono::system_clock::now() + absl::ToChronoMicroseconds(wait),
             [weak = weak_from_this(), ring = std::move(ring)](bool is_due) {
               const auto self = weak.lock();
               if (is_due && self != nullptr) ring(static_cast<ExportStream&>(*self));
             });
  absl::MutexLock lock(&mutex_);
  alarm_.swap(alarm);  // the last one may be ringing still, and is let go outside the lock
}

void ExportStream::LetGo() {
  if (host_ != nullptr) host_->end_listeners().Remove(listener_);
  std::unique_ptr<grpc::Alarm> alarm;
  absl::MutexLock lock(&mutex_);
  alarm_.swap(alarm);
}

StreamPump::Operation ExportStream::NextOperation() {
  if (making_) return nullptr;
  if (has_message_) {
    has_message_ = false;
    return WriteWithin(context_.limits.export_patience, &message_);
  }
  making_ = true;
  return [this] { SubmitNext(); };
}

}  // namespace plumescout::server
