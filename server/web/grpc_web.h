// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/status.h>

#include <optional>
#include <string>

#include "absl/strings/string_view.h"
#include "absl/time/time.h"

namespace plumescout::server {

// gRPC-Web: gRPC's messages as browsers can send and read them, a byte of flags and four of length
// before each, and the trailers as the last.
inline constexpr char kGrpcWebType[] = "application/grpc-web+proto";
inline constexpr int kGrpcWebPrefixBytes = 5;

// A method that browsers may call: of plumescout.v1, with one request.
struct WebMethod {
  std::string path;  // "/plumescout.v1.MapService/WatchMap"
  bool is_stream = false;
};
std::optional<WebMethod> FindWebMethod(absl::string_view path);

// The message in the body of a request; none unless it is exactly one, as it is (not compressed).
std::optional<std::string> MessageOfBody(absl::string_view body);

std::string MessageFrame(absl::string_view message);
// What ends an answer, with the details of an error.
std::string TrailerFrame(const grpc::Status& status);

// The longest that is taken: clocks have no room for all that can be written.
inline constexpr absl::Duration kMaxGrpcTimeout = absl::Hours(24);
// A value of the header grpc-timeout, "1500m", or the longest if it is longer; none if it is not
// one.
std::optional<absl::Duration> ParseGrpcTimeout(absl::string_view text);

}  // namespace plumescout::server
