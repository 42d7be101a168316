// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/watch_stream.h"

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "proto/convert/species.h"
#include "server/base/grpc_status.h"
#include "server/calls/unary_call.h"
#include "server/maps/wire_message.h"

namespace plumescout::server {
namespace {

constexpr double kSlowest = 0.001;
constexpr double kFastest = 1e6;

absl::StatusOr<double> SpeedOf(const v1::WatchMapRequest& request) {
  if (request.speed_ratio() == 0.0) return 1.0;
  PLUMESCOUT_RETURN_IF_ERROR(CheckRange("speed_ratio", request.speed_ratio(), kSlowest, kFastest));
  return request.speed_ratio();
}

}  // namespace

WatchStream* WatchStream::Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                                const grpc::ByteBuffer& request) {
  const auto stream = std::make_shared<WatchStream>(context);
  stream->Run(Rpc::kWatchMap, *call, [stream, &request] { return stream->Subscribe(request); });
  return stream.get();
}

absl::Status WatchStream::Subscribe(const grpc::ByteBuffer& bytes) {
  v1::WatchMapRequest request;
  PLUMESCOUT_RETURN_IF_ERROR(Parse(bytes, request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionId mission,
                              ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(view_, MapViewFromProto(request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const double speed_ratio, SpeedOf(request));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMission(visit_.caller(), mission));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSpecies(view_.species, host->options(), "species"));
  feed_ = host->map_feed();
  {
    absl::MutexLock lock(&mutex_);
    host_ = host;
  }
  if (!request.has_from_revision()) return GoLive();
  return BeginReplay(host, {view_, request.from_revision(), speed_ratio});
}

absl::Status WatchStream::GoLive() {
  const auto host = this->host();
  if (host == nullptr) return absl::OkStatus();
  is_live_ = true;
  PLUMESCOUT_RETURN_IF_ERROR(
      feed_->Join(reader(), view_, context_.map_pool,
                  [&](MapFeed::Subscriber told) { return host->Subscribe(std::move(told)); }));
  if (this->host() == nullptr) feed_->Leave(this);  // the caller has left meanwhile
  return absl::OkStatus();
}

absl::Status WatchStream::BeginReplay(const std::shared_ptr<MissionHost>& host,
                                      const ReplayWish& wish) {
  PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
  is_live_ = false;
  const auto replay = std::make_shared<MapReplay>(
      MapReplay::Parts{host, &context_.history->past_missions, context_.past_pool,
                       TurnOf(visit_.info(), host->id()), context_.limits.replay_period},
      wish);
  {
    absl::MutexLock lock(&mutex_);
    replay_ = replay;
  }
  const auto weak = weak_from_this();
  listener_ = host->end_listeners().Add([weak](const absl::Status& status) {
    if (const auto stream = weak.lock()) stream->End(status);
  });
  return replay->Begin(reader(), [this, weak] {
    const auto stream = weak.lock();
    if (stream == nullptr) return;
    const absl::Status status = GoLive();
    if (!status.ok()) End(status);
  });
}

std::shared_ptr<MissionHost> WatchStream::host() {
  absl::MutexLock lock(&mutex_);
  return host_;
}

std::shared_ptr<MapReplay> WatchStream::replay() {
  absl::MutexLock lock(&mutex_);
  return replay_;
}

void WatchStream::AwaitFrames() {
  if (is_live_) return feed_->Await(this);
  replay()->Await();
}

void WatchStream::End(const absl::Status& status) {
  const auto past = replay();
  WriteStream::End(status);
  if (past != nullptr) past->Stop();
}

void WatchStream::Take(std::shared_ptr<const MapFrames> frames) {
  {
    absl::MutexLock lock(&mutex_);
    frames_ = std::move(frames);
    begun_ = 0;
  }
  Pump();
}

void WatchStream::LetGo() {
  std::shared_ptr<MissionHost> host;  // not let go by the writer, which may be the last to hold us
  std::shared_ptr<MapReplay> past;
  {
    absl::MutexLock lock(&mutex_);
    host.swap(host_);
    past.swap(replay_);
  }
  if (past != nullptr) {
    past->Stop();
    host->end_listeners().Remove(listener_);
  }
  if (feed_ != nullptr) feed_->Leave(this);
}

StreamPump::Operation WatchStream::NextOperation() {
  if (frames_ == nullptr) return nullptr;
  if (begun_ == frames_->messages.size()) {
    frames_ = nullptr;
    return [this] { AwaitFrames(); };
  }
  const auto* const message = &frames_->messages[begun_++];
  if (is_live_) return Write(message);
  return WriteWithin(context_.limits.export_patience, message);  // it holds what replays need
}

}  // namespace plumescout::server
