// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "plumescout/v1/map_service.pb.h"
#include "server/history/map_replay.h"
#include "server/maps/map_feed.h"
#include "server/streams/write_stream.h"

namespace plumescout::server {

// One watcher of a mission's map. It asks for frames when those before are on their way: a slow
// watcher skips beliefs, and holds bytes that it shares with the others, never a queue. A watcher
// of the past gets frames of a replay first.
class WatchStream final : public WriteStream<grpc::ByteBuffer>, public MapReader {
 public:
  // `request`: a v1::WatchMapRequest.
  static WatchStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                            const grpc::ByteBuffer& request);

  explicit WatchStream(const ServiceContext* context) : WriteStream(context) {}

  void End(const absl::Status& status) override;
  void Take(std::shared_ptr<const MapFrames> frames) override;

 private:
  absl::Status Subscribe(const grpc::ByteBuffer& request);
  absl::Status BeginReplay(const std::shared_ptr<MissionHost>& host, const ReplayWish& wish);
  absl::Status GoLive();
  std::shared_ptr<MapReader> reader() { return {shared_from_this(), this}; }
  std::shared_ptr<MissionHost> host() ABSL_LOCKS_EXCLUDED(mutex_);
  std::shared_ptr<MapReplay> replay() ABSL_LOCKS_EXCLUDED(mutex_);
  // From where the present frames came.
  void AwaitFrames();
  StreamPump::Operation NextOperation() override ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void LetGo() override;

  MapView view_;
  std::shared_ptr<MapFeed> feed_;  // null if the call was refused
  EndListeners::Id listener_ = 0;  // of the mission's end, for the replay
  std::atomic<bool> is_live_ = true;

  // Until LetGo: whoever holds a mission uses it.
  std::shared_ptr<MissionHost> host_ ABSL_GUARDED_BY(mutex_);
  // Until LetGo; null: live from the beginning.
  std::shared_ptr<MapReplay> replay_ ABSL_GUARDED_BY(mutex_);
  std::shared_ptr<const MapFrames> frames_ ABSL_GUARDED_BY(mutex_);  // null while it waits for some
  std::size_t begun_ ABSL_GUARDED_BY(mutex_) = 0;  // messages of these, the last is being written
};

}  // namespace plumescout::server
