// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/export_stream.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "server/base/log.h"

namespace plumescout::server {

ExportStream* ExportStream::Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                                  const v1::ExportMissionRequest& request) {
  const auto stream = std::make_shared<ExportStream>(context);
  stream->Run(Rpc::kExportMission, *call, [&] { return stream->Begin(request); });
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
  Submit([this, self = shared_from_this(), point = *point] { Open(point); });
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

bool ExportStream::HasEnded() {
  absl::MutexLock lock(&mutex_);
  return has_ended();
}

void ExportStream::MakeNext() {
  if (HasEnded()) return;
  auto next = export_->Next();
  if (!next.ok()) return End(next.status());
  if (!next->has_value()) return End(absl::OkStatus());
  if ((*next)->part_case() == v1::ExportMissionResponse::PART_NOT_SET) {
    return Submit([this, self = shared_from_this()] { MakeNext(); });
  }
  message_ = **std::move(next);
  {
    absl::MutexLock lock(&mutex_);
    making_ = false;
    has_message_ = true;
  }
  Pump();
}

void ExportStream::Submit(std::function<void()> task) {
  const absl::Status queued = context_.query_pool->Submit(std::move(task));
  if (!queued.ok()) End(queued);
}

void ExportStream::LetGo() {
  if (host_ != nullptr) host_->end_listeners().Remove(listener_);
}

StreamPump::Operation ExportStream::NextOperation() {
  if (making_) return nullptr;
  if (has_message_) {
    has_message_ = false;
    return Write(&message_);
  }
  making_ = true;
  return [this] { Submit([this, self = shared_from_this()] { MakeNext(); }); };
}

}  // namespace plumescout::server
