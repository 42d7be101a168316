// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include <deque>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "core/types/map_snapshot.h"
#include "plumescout/v1/map_service.pb.h"
#include "proto/convert/map.h"
#include "server/streams/active_streams.h"
#include "server/streams/service_context.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// One watcher of a mission's map. Frames are made on the map pool, from the newest belief and what
// the watcher holds, only when the frames before are on their way: a slow watcher skips beliefs
// and costs one snapshot, never a queue.
class WatchStream final : public grpc::ServerWriteReactor<v1::WatchMapResponse>,
                          public EndableStream,
                          public std::enable_shared_from_this<WatchStream> {
 public:
  // The reactor owns itself until gRPC is done with it.
  static WatchStream* Start(const ServiceContext* context, const v1::WatchMapRequest& request);

  explicit WatchStream(const ServiceContext* context) : context_(*context) {}

  void End(const absl::Status& status) override;

  void OnWriteDone(bool ok) override;
  void OnCancel() override { End(absl::CancelledError("the caller gave up")); }
  void OnDone() override;

 private:
  using BeliefPtr = std::shared_ptr<const Belief>;

  absl::Status Subscribe(const v1::WatchMapRequest& request);
  // False once the stream is over.
  bool Update(absl::StatusOr<BeliefPtr> belief);
  void MakeFrames(const Belief& belief);
  // Starts whatever can start now: a write, the making of frames, the finish.
  void Pump() ABSL_LOCKS_EXCLUDED(mutex_);
  StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void StartMaking(BeliefPtr belief) ABSL_LOCKS_EXCLUDED(mutex_);

  const ServiceContext& context_;
  std::shared_ptr<WatchStream> self_;  // until OnDone
  MissionId mission_;
  MapView view_;

  std::shared_ptr<const MapSnapshot> held_;  // by the watcher; touched by one MakeFrames at a time

  absl::Mutex mutex_;
  StreamPump pump_;
  BeliefPtr newest_ ABSL_GUARDED_BY(mutex_);  // null if the frames made already hold it
  std::deque<v1::WatchMapResponse> frames_ ABSL_GUARDED_BY(mutex_);  // the front is in flight
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool making_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
