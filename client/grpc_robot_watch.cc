// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_robot_watch.h"

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

#include "absl/time/clock.h"
#include "client/grpc_status.h"
#include "proto/convert/names.h"
#include "proto/convert/robot_notice.h"

namespace plumescout::client {
namespace {

// An operation on the call; its value is the completion queue's tag.
enum class WatchOp : std::intptr_t { kStart = 1, kRead, kFinish };

void* TagOf(WatchOp op) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(op)); }

// A call driven through a completion queue of its own: no thread is needed, and what came waits at
// most one message deep here; the rest waits at the server, which keeps the newest of each kind.
class GrpcRobotWatch final : public RobotWatch {
 public:
  GrpcRobotWatch(v1::RobotService::Stub& stub, const RobotSession& session) {
    v1::WatchRobotRequest request;
    request.set_robot(RobotResource({session.mission, session.robot}));
    request.set_lease_token(session.lease_token);
    call_ = stub.PrepareAsyncWatchRobot(&context_, request, &queue_);
    call_->StartCall(TagOf(WatchOp::kStart));
  }
  ~GrpcRobotWatch() override {
    context_.TryCancel();
    while (!finished_) {
      if (std::exchange(arrived_, false)) call_->Read(&incoming_, TagOf(WatchOp::kRead));
      RunOne(absl::InfiniteFuture());
    }
    queue_.Shutdown();
    while (RunOne(absl::InfiniteFuture())) {
    }
  }

  absl::StatusOr<RobotNotice> Read(absl::Duration timeout) override {
    const absl::Time deadline = absl::Now() + timeout;
    while (!arrived_ && !finished_) {
      if (!RunOne(deadline)) return absl::DeadlineExceededError("no notice yet");
    }
    if (!arrived_) return Ended();
    absl::StatusOr<RobotNotice> notice = FromProto(incoming_);
    arrived_ = false;
    call_->Read(&incoming_, TagOf(WatchOp::kRead));
    if (!notice.ok()) return absl::InternalError(notice.status().message());
    return notice;
  }

  void Cancel() override {
    cancelled_ = true;
    context_.TryCancel();
  }

 private:
  // Runs one completion; false after the deadline, or once the queue is shut down.
  bool RunOne(absl::Time deadline) {
    void* tag = nullptr;
    bool ok = false;
    if (queue_.AsyncNext(&tag, &ok, absl::ToChronoTime(deadline)) !=
        grpc::CompletionQueue::GOT_EVENT) {
      return false;
    }
    const auto op = static_cast<WatchOp>(reinterpret_cast<std::intptr_t>(tag));
    if (op == WatchOp::kFinish) {
      finished_ = true;
    } else if (!ok) {
      call_->Finish(&final_, TagOf(WatchOp::kFinish));
    } else if (op == WatchOp::kStart) {
      call_->Read(&incoming_, TagOf(WatchOp::kRead));
    } else {
      arrived_ = true;
    }
    return true;
  }

  absl::Status Ended() const {
    if (cancelled_) return absl::CancelledError("the watch was cancelled");
    const absl::Status status = FromGrpc(final_);
    // To readers kDeadlineExceeded means that nothing came.
    const bool misleads = status.ok() || absl::IsDeadlineExceeded(status);
    return misleads ? absl::UnavailableError("the server closed the watch") : status;
  }

  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::ClientAsyncReader<v1::WatchRobotResponse>> call_;
  v1::WatchRobotResponse incoming_;
  bool arrived_ = false;  // and was not read yet: no read is under way
  bool finished_ = false;
  grpc::Status final_;
  std::atomic<bool> cancelled_ = false;
};

}  // namespace

std::unique_ptr<RobotWatch> OpenGrpcRobotWatch(v1::RobotService::Stub& stub,
                                               const RobotSession& session) {
  return std::make_unique<GrpcRobotWatch>(stub, session);
}

}  // namespace plumescout::client
