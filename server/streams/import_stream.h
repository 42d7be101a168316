// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/support/server_callback.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/calls/active_streams.h"
#include "server/calls/service_context.h"
#include "server/history/mission_import.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// A mission on its way in. The next part is read when the last has been dealt with, on the import
// desk's thread; whoever sends nothing for too long is hung up on.
class ImportStream final : public grpc::ServerReadReactor<v1::ImportMissionRequest>,
                           public EndableStream,
                           public std::enable_shared_from_this<ImportStream> {
 public:
  // Says what a mission is.
  using Describe = std::function<v1::Mission(MissionHost&)>;

  // The reactor owns itself until gRPC is done with it. `response` lives as long.
  static ImportStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                             v1::ImportMissionResponse* response, Describe describe);

  ImportStream(const ServiceContext* context, v1::ImportMissionResponse* response,
               Describe describe)
      : context_(*context), response_(response), describe_(std::move(describe)) {}

  // What runs is cut short, and then the call ends.
  void End(const absl::Status& status) override;

  void OnReadDone(bool ok) override;
  void OnCancel() override { End(absl::CancelledError("the caller gave up")); }
  void OnDone() override;

 private:
  // On the desk's thread, one at a time.
  void Handle();
  absl::Status HandlePart();
  absl::Status Open(const v1::ImportStart& start);
  absl::Status Conclude(const v1::MissionFileEnd& end);

  void SetAlarm();
  void Pump() ABSL_LOCKS_EXCLUDED(mutex_);
  StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const ServiceContext& context_;
  v1::ImportMissionResponse* const response_;
  const Describe describe_;
  std::shared_ptr<ImportStream> self_;  // until OnDone
  Visit visit_;
  std::atomic<bool> stopped_ = false;

  v1::ImportMissionRequest request_;  // of the read, then of the desk's thread
  // Of the desk's thread.
  ImportWish wish_;
  std::unique_ptr<MissionImport> import_;  // null: not opened

  absl::Mutex mutex_;
  StreamPump pump_;
  std::unique_ptr<grpc::Alarm> alarm_ ABSL_GUARDED_BY(mutex_);  // while it reads
  bool reading_ ABSL_GUARDED_BY(mutex_) = false;
  bool handling_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
