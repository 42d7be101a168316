// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include <functional>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/calls/active_streams.h"
#include "server/calls/service_context.h"
#include "server/history/mission_export.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// A mission on its way out. One message is made, on a pool, while none is being written: a slow
// reader costs one message, and no thread.
class ExportStream final : public grpc::ServerWriteReactor<v1::ExportMissionResponse>,
                           public EndableStream,
                           public std::enable_shared_from_this<ExportStream> {
 public:
  // The reactor owns itself until gRPC is done with it.
  static ExportStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                             const v1::ExportMissionRequest& request);

  explicit ExportStream(const ServiceContext* context) : context_(*context) {}

  void End(const absl::Status& status) override;

  void OnWriteDone(bool ok) override;
  void OnCancel() override { End(absl::CancelledError("the caller gave up")); }
  void OnDone() override;

 private:
  absl::Status Begin(const v1::ExportMissionRequest& request);
  void BeginAt(const absl::StatusOr<ExportPoint>& point);
  // On the pool, one at a time.
  void Open(const ExportPoint& point);
  void MakeNext();
  void Submit(std::function<void()> task);

  void Pump() ABSL_LOCKS_EXCLUDED(mutex_);
  StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const ServiceContext& context_;
  std::shared_ptr<ExportStream> self_;  // until OnDone
  Visit visit_;
  std::shared_ptr<MissionHost> host_;      // set before anything else begins
  EndListeners::Id listener_ = 0;          // of the mission's end
  std::unique_ptr<MissionExport> export_;  // of the pool's task
  v1::ExportMissionResponse message_;      // of who makes it, then of who writes it

  absl::Mutex mutex_;
  StreamPump pump_;
  bool has_message_ ABSL_GUARDED_BY(mutex_) = false;
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
