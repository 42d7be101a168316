// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/alarm.h>

#include <functional>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/base/clock.h"
#include "server/history/mission_export.h"
#include "server/streams/write_stream.h"

namespace plumescout::server {

// A mission on its way out. One message is made, on a pool, while none is being written: a slow
// reader costs one message, and no thread. Who does not take a message for export_patience is hung
// up on, for what is exported is held meanwhile. A pool that is full refuses an export that begins
// (OVERLOADED); one that has begun waits for room as long.
class ExportStream final : public WriteStream<v1::ExportMissionResponse> {
 public:
  static ExportStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                             const v1::ExportMissionRequest& request);

  explicit ExportStream(const ServiceContext* context) : WriteStream(context) {}

 private:
  absl::Status Begin(const v1::ExportMissionRequest& request);
  void BeginAt(const absl::StatusOr<ExportPoint>& point);
  absl::Status Submit(std::function<void()> task);
  // On the pool, one at a time.
  void Open(const ExportPoint& point);
  void MakeNext();
  void SubmitNext();
  // Has `ring` run then, unless the stream is gone or another alarm was set.
  void SetAlarm(absl::Duration wait, std::function<void(ExportStream&)> ring)
      ABSL_LOCKS_EXCLUDED(mutex_);

  StreamPump::Operation NextOperation() override ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void LetGo() override;

  std::shared_ptr<MissionHost> host_;      // set before anything else begins
  bool as_mcap_ = false;                   // as above
  EndListeners::Id listener_ = 0;          // of the mission's end
  std::unique_ptr<MissionExport> export_;  // of the pool's task
  v1::ExportMissionResponse message_;      // of who makes it, then of who writes it
  std::optional<SteadyTime> room_by_;      // while the pool is full; of who makes the message

  // The message is with the pool, or with whoever prepares that; not so: it is to be made anew.
  bool making_ ABSL_GUARDED_BY(mutex_) = true;
  bool has_message_ ABSL_GUARDED_BY(mutex_) = false;            // to be written
  std::unique_ptr<grpc::Alarm> alarm_ ABSL_GUARDED_BY(mutex_);  // of the last wait
};

}  // namespace plumescout::server
