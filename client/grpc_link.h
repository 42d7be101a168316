// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/duration.pb.h>
#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/grpc_client_options.h"
#include "client/mission_routes.h"
#include "client/request_ids.h"

namespace plumescout::client {

// One connection to a server, opened at the first call and again whenever it breaks, and the calls
// that are answered once. Thread-safe.
class GrpcLink {
 public:
  explicit GrpcLink(const GrpcClientOptions& options);

  const GrpcClientOptions& options() const { return options_; }
  // What stubs are made of.
  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  // Where missions are, if several servers are behind the target.
  MissionRoutes& routes() const { return routes_; }

  // `method` of a generated stub. As GrpcClientOptions::call_timeout says of `timeout`. A call that
  // is for another server behind the target is made again.
  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status Call(Stub& stub, Method method, const Request& request, Response* response,
                    absl::Duration timeout) const {
    const absl::Time deadline = absl::Now() + timeout;
    const std::string mission = MissionOf(request);
    grpc::Status status;
    for (int redirect = 0; redirect <= MissionRoutes::kMaxRedirects; ++redirect) {
      grpc::ClientContext context;
      Prepare(context, deadline);
      const std::string node = routes_.Address(mission, context);
      status = (stub.*method)(&context, request, response);
      if (!routes_.Note(mission, node, status, context)) break;
    }
    return Judge(status, timeout);
  }
  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status Call(Stub& stub, Method method, const Request& request, Response* response) const {
    return Call(stub, method, request, response, options_.call_timeout);
  }

  // The same for calls that may be made twice without harm, as those that only read: one whose
  // connection broke under it, as by a restart of the server since the last call, is made again.
  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status Ask(Stub& stub, Method method, const Request& request, Response* response) const {
    const absl::Time deadline = absl::Now() + options_.call_timeout;
    absl::Status status;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      status = Call(stub, method, request, response, deadline - absl::Now());
      if (!IsBroken(status) || absl::Now() >= deadline) break;
    }
    return status;
  }

  // The request has a name, by which the server knows it again when it is made again because its
  // answer was lost.
  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status CallNamed(Stub& stub, Method method, Request request, Response* response,
                         absl::Duration timeout) {
    const std::string content = absl::StrCat(request.GetTypeName(), request.SerializeAsString());
    request.set_request_id(request_ids_.NameOf(content));
    const absl::Status status = Call(stub, method, request, response, timeout);
    request_ids_.NoteEnd(content, request.request_id(), status);
    return status;
  }
  template <typename Stub, typename Method, typename Request, typename Response>
  absl::Status CallNamed(Stub& stub, Method method, const Request& request, Response* response) {
    return CallNamed(stub, method, request, response, options_.call_timeout);
  }

  // Waits for a link for as long as an attempt takes, and the pause before it. Between calls that
  // fail at once nobody drives the channel's attempts, and gRPC looks at them every five seconds
  // only; whoever waits for the channel drives them. Whether there is one.
  bool AwaitLink() const;

 private:
  static constexpr int kAttempts = 3;

  static void Prepare(grpc::ClientContext& context, absl::Time deadline);
  // What a call that took so long at most has come to.
  absl::Status Judge(const grpc::Status& status, absl::Duration timeout) const;
  // Whether a call failed without a word from the server.
  static bool IsBroken(const absl::Status& status);

  const GrpcClientOptions options_;
  RequestIds request_ids_;
  mutable MissionRoutes routes_;
  const std::shared_ptr<grpc::Channel> channel_;
};

// What is longer than the wire can say becomes as long as it can say.
void SetDuration(absl::Duration duration, google::protobuf::Duration* proto);

}  // namespace plumescout::client
