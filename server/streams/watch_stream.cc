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
  auto stream = std::make_shared<WatchStream>(context);
  stream->self_ = stream;
  context->streams->Add(stream);
  absl::Status status = stream->visit_.Enter(*context->door, Rpc::kWatchMap, *call);
  context->streams->LetIn(stream.get(), stream->visit_.info().recheck);
  if (status.ok()) status = stream->Subscribe(request);
  if (!status.ok()) stream->End(status);
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
      feed_->Join(shared_from_this(), view_, context_.map_pool,
                  [&](MapFeed::Subscriber told) { return host->Subscribe(std::move(told)); }));
  if (this->host() == nullptr) feed_->Leave(this);  // the caller has left meanwhile
  return absl::OkStatus();
}

absl::Status WatchStream::BeginReplay(const std::shared_ptr<MissionHost>& host,
                                      const ReplayWish& wish) {
  PLUMESCOUT_RETURN_IF_ERROR(context_.CheckKeepsHistory());
  is_live_ = false;
  const auto replay = std::make_shared<MapReplay>(
      MapReplay::Parts{host, &context_.history->past_missions, context_.query_pool,
                       context_.limits.replay_period},
      wish);
  {
    absl::MutexLock lock(&mutex_);
    replay_ = replay;
  }
  const std::weak_ptr<WatchStream> weak = weak_from_this();
  listener_ = host->end_listeners().Add([weak](const absl::Status& status) {
    if (const auto stream = weak.lock()) stream->End(status);
  });
  return replay->Begin(shared_from_this(), [weak] {
    const auto stream = weak.lock();
    if (stream == nullptr) return;
    const absl::Status status = stream->GoLive();
    if (!status.ok()) stream->End(status);
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
  {
    absl::MutexLock lock(&mutex_);
    if (!end_.has_value()) end_ = status;
  }
  if (const auto past = replay()) past->Stop();
  Pump();
}

void WatchStream::Take(std::shared_ptr<const MapFrames> frames) {
  {
    absl::MutexLock lock(&mutex_);
    frames_ = std::move(frames);
    written_ = 0;
  }
  Pump();
}

void WatchStream::OnWriteDone(bool ok) {
  {
    absl::MutexLock lock(&mutex_);
    writing_ = false;
    ++written_;
    if (!ok && !end_.has_value()) end_ = absl::CancelledError("the stream broke");
  }
  Pump();
}

void WatchStream::OnDone() {
  context_.streams->Remove(this);
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
  self_.reset();
}

void WatchStream::Pump() {
  const auto self = shared_from_this();  // the finish may end us
  pump_.Run(mutex_, [this] {
    mutex_.AssertHeld();
    return NextOperation();
  });
}

StreamPump::Operation WatchStream::NextOperation() {
  if (finished_ || writing_) return nullptr;
  if (end_.has_value()) {
    finished_ = true;
    return [this, status = *end_] {
      visit_.Leave(status);
      Finish(ToGrpc(status, visit_.info().request_id));
    };
  }
  if (frames_ == nullptr) return nullptr;
  if (written_ == frames_->messages.size()) {
    frames_ = nullptr;
    return [this] { AwaitFrames(); };
  }
  writing_ = true;
  return [this, message = &frames_->messages[written_]] { StartWrite(message); };
}

}  // namespace plumescout::server
