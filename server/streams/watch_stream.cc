// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/watch_stream.h"

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "server/base/grpc_status.h"
#include "server/maps/wire_message.h"

namespace plumescout::server {

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
  PLUMESCOUT_ASSIGN_OR_RETURN(const MapView view, MapViewFromProto(request));
  PLUMESCOUT_ASSIGN_OR_RETURN(host_, context_.FindMission(visit_.caller(), mission));
  feed_ = host_->map_feed();
  return feed_->Join(shared_from_this(), view, context_.map_pool,
                     [&](MapFeed::Subscriber told) { return host_->Subscribe(std::move(told)); });
}

void WatchStream::End(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    if (!end_.has_value()) end_ = status;
  }
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
  if (feed_ != nullptr) feed_->Leave(this);
  host_.reset();  // not by the writer, which may be the last to hold this stream
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
    return [this] { feed_->Await(this); };
  }
  writing_ = true;
  return [this, message = &frames_->messages[written_]] { StartWrite(message); };
}

}  // namespace plumescout::server
