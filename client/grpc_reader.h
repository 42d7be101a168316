// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/grpc_status.h"
#include "client/mission_routes.h"

namespace plumescout::client {

// A call that is asked once and answered by a stream, driven through a completion queue of its own:
// no thread is needed, and what came waits at most one message deep here; the rest waits at the
// server. Not thread-safe, but for Cancel.
template <typename Response>
class GrpcReader {
 public:
  // `prepare`: of the stub, &Stub::PrepareAsyncX. Does not wait for the server. The stub and the
  // routes outlive it. A call that is for another server is made again, as of GrpcLink.
  template <typename Stub, typename Prepare, typename Request>
  GrpcReader(MissionRoutes& routes, Stub& stub, Prepare prepare, const Request& request,
             absl::Time deadline = absl::InfiniteFuture())
      : routes_(routes),
        mission_(MissionOf(request)),
        deadline_(deadline),
        prepare_(
            [&stub, prepare, request](grpc::ClientContext* context, grpc::CompletionQueue* queue) {
              return (stub.*prepare)(context, request, queue);
            }) {
    Begin();
  }
  ~GrpcReader() {
    Cancel();
    while (!finished_) {
      if (std::exchange(arrived_, false)) call_->Read(&incoming_, TagOf(Op::kRead));
      RunOne(absl::InfiniteFuture());
    }
    queue_.Shutdown();
    while (RunOne(absl::InfiniteFuture())) {
    }
  }
  GrpcReader(const GrpcReader&) = delete;
  GrpcReader& operator=(const GrpcReader&) = delete;

  // The next message; none once the server has ended the call well. kDeadlineExceeded if none came
  // (the call lives on), and for nothing else: to its callers a deadline of the server is
  // kUnavailable. After any other error it is dead.
  absl::StatusOr<std::optional<Response>> Read(absl::Duration timeout) {
    const absl::Time deadline = absl::Now() + timeout;
    while (!arrived_ && !finished_) {
      if (!RunOne(deadline)) return absl::DeadlineExceededError("nothing came yet");
    }
    if (!arrived_) return Ended();
    std::optional<Response> message = std::exchange(incoming_, Response());
    arrived_ = false;
    call_->Read(&incoming_, TagOf(Op::kRead));
    return message;
  }

  // A Read that waits, and each after it, is kCancelled.
  void Cancel() {
    absl::MutexLock lock(&mutex_);
    cancelled_ = true;
    context_->TryCancel();
  }

 private:
  // An operation on the call; its value is the completion queue's tag.
  enum class Op : std::intptr_t { kStart = 1, kRead, kFinish };
  static void* TagOf(Op op) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(op)); }

  void Begin() {
    call_.reset();
    context_ = std::make_unique<grpc::ClientContext>();
    if (deadline_ != absl::InfiniteFuture()) {
      context_->set_deadline(absl::ToChronoTime(deadline_));
    }
    node_ = routes_.Address(mission_, *context_);
    call_ = prepare_(context_.get(), &queue_);
    call_->StartCall(TagOf(Op::kStart));
  }
  // Whether the call that has ended begins again, at another server.
  bool Redirect() {
    if (!routes_.Note(mission_, node_, final_, *context_)) return false;
    absl::MutexLock lock(&mutex_);  // nobody cancels the call that goes
    if (cancelled_ || any_came_ || redirects_++ == MissionRoutes::kMaxRedirects) return false;
    Begin();
    return true;
  }

  // Runs one completion; false after the deadline, or once the queue is shut down.
  bool RunOne(absl::Time deadline) {
    void* tag = nullptr;
    bool ok = false;
    if (queue_.AsyncNext(&tag, &ok, absl::ToChronoTime(deadline)) !=
        grpc::CompletionQueue::GOT_EVENT) {
      return false;
    }
    const auto op = static_cast<Op>(reinterpret_cast<std::intptr_t>(tag));
    if (op == Op::kFinish) {
      finished_ = !Redirect();
    } else if (!ok) {
      call_->Finish(&final_, TagOf(Op::kFinish));
    } else if (op == Op::kStart) {
      call_->Read(&incoming_, TagOf(Op::kRead));
    } else {
      arrived_ = any_came_ = true;
    }
    return true;
  }

  absl::StatusOr<std::optional<Response>> Ended() const {
    if (cancelled_) return absl::CancelledError("the call was cancelled");
    const absl::Status status = FromGrpc(final_);
    if (status.ok()) return std::nullopt;
    return absl::IsDeadlineExceeded(status) ? absl::UnavailableError(status.message()) : status;
  }

  MissionRoutes& routes_;
  const std::string mission_;
  const absl::Time deadline_;
  const std::function<std::unique_ptr<grpc::ClientAsyncReader<Response>>(grpc::ClientContext*,
                                                                         grpc::CompletionQueue*)>
      prepare_;
  absl::Mutex mutex_;  // of context_, as others cancel
  std::unique_ptr<grpc::ClientContext> context_;
  std::string node_;  // that the call is addressed to
  int redirects_ = 0;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::ClientAsyncReader<Response>> call_;
  Response incoming_;
  bool arrived_ = false;  // and was not read yet: no read is under way
  bool any_came_ = false;
  bool finished_ = false;
  grpc::Status final_;
  std::atomic<bool> cancelled_ = false;
};

// Of a stream that has no end by itself.
template <typename Response>
absl::StatusOr<Response> ReadEndless(GrpcReader<Response>& reader, absl::Duration timeout) {
  absl::StatusOr<std::optional<Response>> message = reader.Read(timeout);
  if (!message.ok()) return message.status();
  if (!message->has_value()) return absl::UnavailableError("the server closed the watch");
  return **std::move(message);
}

}  // namespace plumescout::client
