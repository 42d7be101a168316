// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/web_call.h"

#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <utility>
#include <vector>

#include "server/web/grpc_web.h"

namespace plumescout::server {
namespace {

std::string BytesOf(const grpc::ByteBuffer& buffer) {
  std::string bytes;
  std::vector<grpc::Slice> slices;
  if (!buffer.Dump(&slices).ok()) return bytes;
  bytes.reserve(buffer.Length());
  for (const grpc::Slice& slice : slices) {
    bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  }
  return bytes;
}

}  // namespace

std::unique_ptr<WebCall> WebCall::Start(const std::shared_ptr<grpc::Channel>& channel,
                                        Parts parts) {
  std::unique_ptr<WebCall> call(new WebCall(std::move(parts)));
  call->Begin(channel);
  return call;
}

WebCall::~WebCall() {
  Cancel();
  left_alone_.WaitForNotification();
}

void WebCall::Begin(const std::shared_ptr<grpc::Channel>& channel) {
  for (const auto& [name, value] : parts_.metadata) context_.AddMetadata(name, value);
  if (parts_.timeout.has_value()) {
    context_.set_deadline(std::chrono::system_clock::now() +
                          absl::ToChronoMilliseconds(*parts_.timeout));
  }
  const grpc::Slice message(parts_.message);
  request_ = grpc::ByteBuffer(&message, 1);
  grpc::GenericStub(channel).PrepareBidiStreamingCall(&context_, parts_.method, {}, this);
  // Reads begin outside of gRPC's callbacks, too: until one fails, the call is not done.
  AddHold();
  StartWriteLast(&request_, grpc::WriteOptions());
  StartRead(&response_);
  StartCall();
}

std::string WebCall::Take() {
  std::string taken;
  {
    const absl::MutexLock lock(&mutex_);
    taken.swap(waiting_);
    if (!std::exchange(may_read_, false)) return taken;
  }
  StartRead(&response_);
  return taken;
}

bool WebCall::ended() const {
  const absl::MutexLock lock(&mutex_);
  return done_ && waiting_.empty();
}

void WebCall::Cancel() {
  context_.TryCancel();
  {
    const absl::MutexLock lock(&mutex_);
    cancelled_ = true;
    if (!std::exchange(may_read_, false)) return;
  }
  StartRead(&response_);
}

void WebCall::OnReadDone(bool ok) {
  if (!ok) return RemoveHold();
  bool read_on = false;
  {
    const absl::MutexLock lock(&mutex_);
    read_on = cancelled_;
    may_read_ = !cancelled_;
    if (!cancelled_) waiting_ = MessageFrame(BytesOf(response_));
  }
  if (read_on) return StartRead(&response_);
  parts_.wake();
}

void WebCall::OnDone(const grpc::Status& status) {
  {
    const absl::MutexLock lock(&mutex_);
    waiting_ += TrailerFrame(status);
    done_ = true;
  }
  parts_.wake();
  left_alone_.Notify();
}

}  // namespace plumescout::server
