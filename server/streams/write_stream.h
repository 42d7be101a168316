// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/support/server_callback.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
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
    std::unique_ptr<grpc::Alarm> patience;  // which may be ringing, so not let go under the lock
    {
      absl::MutexLock lock(&mutex_);
      patience.swap(patience_);
    }
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
  // The same of a stream that holds what others may need: who does not take the message for so long
  // is hung up on (kDeadlineExceeded).
  StreamPump::Operation WriteWithin(absl::Duration patience, const Message* message)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    StreamPump::Operation write = Write(message);
    return [this, write = std::move(write), number = write_count_, patience] {
      HangUpAfter(patience, number);
      write();
    };
  }
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
  void HangUpAfter(absl::Duration patience, std::int64_t write) ABSL_LOCKS_EXCLUDED(mutex_) {
    auto alarm = std::make_unique<grpc::Alarm>();
    alarm->Set(std::chrono::system_clock::now() + absl::ToChronoMicroseconds(patience),
               [weak = this->weak_from_this(), write, patience](bool is_due) {
                 const auto self = weak.lock();
                 if (!is_due || self == nullptr) return;
                 self->HangUp(write,
                              absl::DeadlineExceededError(absl::StrCat(
                                  "a piece was not taken for ", absl::FormatDuration(patience))));
               });
    absl::MutexLock lock(&mutex_);
    patience_.swap(alarm);  // the last one may be ringing still, and is let go outside the lock
  }
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
  std::unique_ptr<grpc::Alarm> patience_ ABSL_GUARDED_BY(mutex_);  // with the last write
};

}  // namespace plumescout::server
