// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_link.h"

#include <grpcpp/support/channel_arguments.h>

#include <algorithm>
#include <cstdint>

#include "client/grpc_status.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace {

// Pings and their patience match the server's minimum ping interval; see the wire's documentation.
constexpr int kKeepaliveTime_ms = 10'000;
constexpr int kKeepaliveTimeout_ms = 5'000;
constexpr int kMinReconnect_ms = 100;
constexpr int kMaxReconnect_ms = 500;
constexpr absl::Duration kLinkPatience = absl::Milliseconds(600);
constexpr int kMaxReceive_bytes = 256 << 20;  // more than any server sends in one part of a map
constexpr std::int64_t kMaxDuration_s = 315'576'000'000;  // of a google.protobuf.Duration

grpc::ChannelArguments MakeArguments() {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveTime_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeout_ms);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // as many as it takes
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kMinReconnect_ms);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kMinReconnect_ms);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kMaxReconnect_ms);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // one connection a client
  arguments.SetMaxReceiveMessageSize(kMaxReceive_bytes);
  return arguments;
}

}  // namespace

GrpcLink::GrpcLink(const GrpcClientOptions& options)
    : options_(options),
      channel_(MakeChannel(options.target, options.credentials, MakeArguments())) {}

std::shared_ptr<GrpcLink> MakeGrpcLink(const GrpcClientOptions& options) {
  return std::make_shared<GrpcLink>(options);
}

void GrpcLink::Prepare(grpc::ClientContext& context, absl::Time deadline) {
  context.set_deadline(absl::ToChronoTime(deadline));
  context.set_wait_for_ready(true);
}

absl::Status GrpcLink::Judge(const grpc::Status& grpc_status, absl::Duration timeout) const {
  const absl::Status status = FromGrpc(grpc_status);
  const bool linked = channel_->GetState(/*try_to_connect=*/false) == GRPC_CHANNEL_READY;
  if (!absl::IsDeadlineExceeded(status) || linked) return status;
  return absl::UnavailableError(
      absl::StrCat("no link to ", options_.target, " within ", absl::FormatDuration(timeout)));
}

bool GrpcLink::IsBroken(const absl::Status& status) {
  // A front says the other two when the server behind it ends in the middle of a call.
  const bool is_of_link =
      absl::IsUnavailable(status) || absl::IsUnknown(status) || absl::IsInternal(status);
  return is_of_link && Reason(status).empty();
}

bool GrpcLink::AwaitLink() const {
  return channel_->WaitForConnected(absl::ToChronoTime(absl::Now() + kLinkPatience));
}

void SetDuration(absl::Duration duration, google::protobuf::Duration* proto) {
  duration = std::min(duration, absl::Seconds(kMaxDuration_s));
  proto->set_seconds(absl::IDivDuration(duration, absl::Seconds(1), &duration));
  proto->set_nanos(static_cast<std::int32_t>(absl::ToInt64Nanoseconds(duration)));
}

}  // namespace plumescout::client
