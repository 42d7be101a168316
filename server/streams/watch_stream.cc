// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/watch_stream.h"

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "server/base/grpc_status.h"
#include "server/streams/map_frames.h"

namespace plumescout::server {

WatchStream* WatchStream::Start(const ServiceContext* context, const v1::WatchMapRequest& request) {
  auto stream = std::make_shared<WatchStream>(context);
  stream->self_ = stream;
  context->streams->Add(stream);
  const absl::Status status = stream->Subscribe(request);
  if (!status.ok()) stream->End(status);
  return stream.get();
}

absl::Status WatchStream::Subscribe(const v1::WatchMapRequest& request) {
  PLUMESCOUT_ASSIGN_OR_RETURN(mission_, ParseMissionName("mission", request.mission()));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      view_, MapViewFromProto(request.layers(), request.full_precision(), "layers"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.registry->Find(mission_));
  return host->Subscribe([weak = weak_from_this()](absl::StatusOr<BeliefPtr> belief) {
    const auto stream = weak.lock();
    return stream != nullptr && stream->Update(std::move(belief));
  });
}

void WatchStream::End(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    if (!end_.has_value()) end_ = status;
  }
  Pump();
}

void WatchStream::OnWriteDone(bool ok) {
  {
    absl::MutexLock lock(&mutex_);
    writing_ = false;
    frames_.pop_front();
    if (!ok && !end_.has_value()) end_ = absl::CancelledError("the stream broke");
  }
  Pump();
}

void WatchStream::OnDone() {
  context_.streams->Remove(this);
  self_.reset();
}

bool WatchStream::Update(absl::StatusOr<BeliefPtr> belief) {
  if (!belief.ok()) {
    End(belief.status());
    return false;
  }
  {
    absl::MutexLock lock(&mutex_);
    if (end_.has_value()) return false;
    newest_ = *std::move(belief);
  }
  Pump();
  return true;
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
    return [this, status = *end_] { Finish(ToGrpc(status)); };
  }
  if (!frames_.empty()) {
    writing_ = true;
    return [this, frame = &frames_.front()] { StartWrite(frame); };
  }
  if (newest_ == nullptr || making_) return nullptr;
  making_ = true;
  return [this, belief = std::exchange(newest_, nullptr)] { StartMaking(belief); };
}

void WatchStream::StartMaking(BeliefPtr belief) {
  const absl::Status queued = context_.map_pool->Submit(
      [self = shared_from_this(), belief = std::move(belief)] { self->MakeFrames(*belief); });
  if (!queued.ok()) End(queued);
}

void WatchStream::MakeFrames(const Belief& belief) {
  auto now = std::make_shared<const MapSnapshot>(MakeMapSnapshot(belief));
  auto made = FramesBetween(held_.get(), *now, mission_, view_);
  held_ = std::move(now);
  {
    absl::MutexLock lock(&mutex_);
    making_ = false;
    for (v1::WatchMapResponse& frame : made) frames_.push_back(std::move(frame));
  }
  Pump();
}

}  // namespace plumescout::server
