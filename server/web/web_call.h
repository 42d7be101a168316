// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/client_callback.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "absl/time/time.h"

namespace plumescout::server {

// A call of a browser on its way through the server's own door, by a channel inside the process. At
// most one message waits to be taken: the next is asked for when it is, so whoever reads slowly
// gets the newest of a map, as any slow reader does, and holds one message. Thread-safe.
class WebCall final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  struct Parts {
    std::string method;                           // "/plumescout.v1.MapService/WatchMap"
    std::string message;                          // the request, serialised
    std::map<std::string, std::string> metadata;  // by lower-case name
    std::optional<absl::Duration> timeout;
    std::function<void()> wake;  // there may be something to take; called on threads of gRPC
  };
  static std::unique_ptr<WebCall> Start(const std::shared_ptr<grpc::Channel>& channel, Parts parts);
  // Cancels, and waits until gRPC has done with the call: not on its threads. One of them that
  // drops the last reference to a channel has to end itself, which it cannot.
  ~WebCall() override;

  // The next frames of gRPC-Web; empty if there are none yet.
  std::string Take() ABSL_LOCKS_EXCLUDED(mutex_);
  // All frames were taken, the trailers last.
  bool ended() const ABSL_LOCKS_EXCLUDED(mutex_);
  // Nobody takes anything any more. Idempotent.
  void Cancel() ABSL_LOCKS_EXCLUDED(mutex_);

  // Of gRPC.
  void OnReadDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;

 private:
  explicit WebCall(Parts parts) : parts_(std::move(parts)) {}

  void Begin(const std::shared_ptr<grpc::Channel>& channel);

  const Parts parts_;
  grpc::ClientContext context_;
  grpc::ByteBuffer request_;
  grpc::ByteBuffer response_;      // of the read that is under way
  absl::Notification left_alone_;  // gRPC touches nothing any more

  mutable absl::Mutex mutex_;
  std::string waiting_ ABSL_GUARDED_BY(mutex_);  // frames to be taken
  // No read is under way, and the next may begin.
  bool may_read_ ABSL_GUARDED_BY(mutex_) = false;
  bool cancelled_ ABSL_GUARDED_BY(mutex_) = false;
  bool done_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace plumescout::server
