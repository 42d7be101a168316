// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "server/base/grpc_status.h"
#include "server/calls/active_streams.h"
#include "server/calls/patient_attempt.h"
#include "server/calls/service_context.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// A stream on which only the server writes: one message is in flight at a time, and the first
// ending counts. What is to be written, and when, is for the classes that derive from it. It owns
// itself until gRPC is done with it.
template <typename Message>
class WriteStream : public grpc::ServerWriteReactor<Message>,
                    public EndableStream,
                    public std::enable_shared_from_this<WriteStream<Message>> {
 public:
  void End(const absl::Status& status) override {
    {
      absl::MutexLock lock(&mutex_);
      if (!end_.has_value()) end_ = status;
    }
    Pump();
  }

  void OnWriteDone(bool ok) final {
    {
      absl::MutexLock lock(&mutex_);
      writing_ = false;
      if (!ok && !end_.has_value()) end_ = absl::CancelledError("the stream broke");
    }
    Pump();
  }
  void OnCancel() final { End(absl::CancelledError("the caller gave up")); }
  void OnDone() final {
    context_.streams->Remove(this);
    LetGo();
    self_.reset();
  }

 protected:
  explicit WriteStream(const ServiceContext* context) : context_(*context) {}

  // Has the caller let in, and then the stream begin (see AttemptPatiently); an error ends it.
  // REQUIRES: called once, by who holds the stream.
  void Run(Rpc rpc, grpc::CallbackServerContext& call, std::function<absl::Status()> begin) {
    self_ = this->shared_from_this();
    call_ = &call;
    context_.streams->Add(self_);
    const absl::Status entered = visit_.Enter(*context_.door, rpc, call);
    context_.streams->LetIn(this, visit_.info().recheck);
    if (!entered.ok()) return End(entered);
    {
      absl::MutexLock lock(&mutex_);
      beginning_ = true;
    }
    const auto self = self_;
    AttemptPatiently(
        context_, visit_.info().deadline,
        [self, begin = std::move(begin)] { return self->HasEnded() ? absl::OkStatus() : begin(); },
        [self](const absl::Status& status) { self->Begun(status); });
  }

  // Starts whatever can start now.
  void Pump() ABSL_LOCKS_EXCLUDED(mutex_) {
    const auto self = this->shared_from_this();  // the finish may end us
    pump_.Run(mutex_, [this] {
      mutex_.AssertHeld();
      return Next();
    });
  }
  // What to start, while the stream goes on and nothing is being written; null: nothing now.
  virtual StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) = 0;
  // Of this message, which stays until nothing is being written.
  StreamPump::Operation Write(const Message* message) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    writing_ = true;
    ++write_count_;
    return [this, message] { this->StartWrite(message); };
  }
  // So far; the last of them may be under way.
  std::int64_t write_count() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return write_count_; }
  // Ends the stream although the caller has not taken the message of this number, on which an end
  // would wait. No effect if it has.
  void HangUp(std::int64_t write, const absl::Status& status) ABSL_LOCKS_EXCLUDED(mutex_) {
    {
      absl::MutexLock lock(&mutex_);
      if (!writing_ || write_count_ != write) return;
      if (!end_.has_value()) end_ = status;
      hanging_up_ = true;
    }
    call_->TryCancel();  // there until the stream is finished, which it is not meanwhile
    {
      absl::MutexLock lock(&mutex_);
      hanging_up_ = false;
    }
    Pump();
  }
  bool has_ended() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return end_.has_value(); }
  bool HasEnded() ABSL_LOCKS_EXCLUDED(mutex_) {
    absl::MutexLock lock(&mutex_);
    return end_.has_value();
  }
  // gRPC is done with the stream: lets go of what it works on.
  virtual void LetGo() = 0;

  const ServiceContext& context_;
  Visit visit_;
  absl::Mutex mutex_;

 private:
  void Begun(const absl::Status& status) ABSL_LOCKS_EXCLUDED(mutex_) {
    {
      absl::MutexLock lock(&mutex_);
      beginning_ = false;
    }
    if (!status.ok()) return End(status);
    Pump();
  }
  StreamPump::Operation Next() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    if (finished_ || beginning_ || writing_ || hanging_up_) return nullptr;
    if (!end_.has_value()) return NextOperation();
    finished_ = true;
    return [this, status = *end_] {
      this->Finish(ToGrpc(visit_.Leave(status), visit_.info().request_id));
    };
  }

  StreamPump pump_;
  std::shared_ptr<WriteStream> self_;            // until OnDone
  grpc::CallbackServerContext* call_ = nullptr;  // as long
  // What the stream begins with is there until that has succeeded or failed for good.
  bool beginning_ ABSL_GUARDED_BY(mutex_) = false;
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  std::int64_t write_count_ ABSL_GUARDED_BY(mutex_) = 0;
  bool hanging_up_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
