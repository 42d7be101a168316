// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "plumescout/v1/map_service.pb.h"
#include "server/calls/active_streams.h"
#include "server/calls/service_context.h"
#include "server/history/map_replay.h"
#include "server/maps/map_feed.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// One watcher of a mission's map. It asks for frames when those before are on their way: a slow
// watcher skips beliefs, and holds bytes that it shares with the others, never a queue. A watcher
// of the past gets frames of a replay first.
class WatchStream final : public grpc::ServerWriteReactor<grpc::ByteBuffer>,
                          public EndableStream,
                          public MapReader,
                          public std::enable_shared_from_this<WatchStream> {
 public:
  // The reactor owns itself until gRPC is done with it. `request`: a v1::WatchMapRequest.
  static WatchStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                            const grpc::ByteBuffer& request);

  explicit WatchStream(const ServiceContext* context) : context_(*context) {}

  void End(const absl::Status& status) override;
  void Take(std::shared_ptr<const MapFrames> frames) override;

  void OnWriteDone(bool ok) override;
  void OnCancel() override { End(absl::CancelledError("the caller gave up")); }
  void OnDone() override;

 private:
  absl::Status Subscribe(const grpc::ByteBuffer& request);
  absl::Status BeginReplay(const std::shared_ptr<MissionHost>& host, const ReplayWish& wish);
  absl::Status GoLive();
  std::shared_ptr<MissionHost> host() ABSL_LOCKS_EXCLUDED(mutex_);
  std::shared_ptr<MapReplay> replay() ABSL_LOCKS_EXCLUDED(mutex_);
  // From where the present frames came.
  void AwaitFrames();
  // Starts whatever can start now: a write, the wait for more frames, the finish.
  void Pump() ABSL_LOCKS_EXCLUDED(mutex_);
  StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const ServiceContext& context_;
  std::shared_ptr<WatchStream> self_;  // until OnDone
  Visit visit_;
  MapView view_;
  std::shared_ptr<MapFeed> feed_;  // null if the call was refused
  EndListeners::Id listener_ = 0;  // of the mission's end, for the replay
  std::atomic<bool> is_live_ = true;

  absl::Mutex mutex_;
  StreamPump pump_;
  // Until OnDone: whoever holds a mission uses it.
  std::shared_ptr<MissionHost> host_ ABSL_GUARDED_BY(mutex_);
  // Until OnDone; null: live from the beginning.
  std::shared_ptr<MapReplay> replay_ ABSL_GUARDED_BY(mutex_);
  std::shared_ptr<const MapFrames> frames_ ABSL_GUARDED_BY(mutex_);  // null while it waits for some
  std::size_t written_ ABSL_GUARDED_BY(mutex_) = 0;                  // messages of these
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
