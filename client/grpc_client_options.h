// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/time/time.h"
#include "client/credentials.h"

namespace plumescout::client {

struct GrpcClientOptions {
  std::string target = "127.0.0.1:50551";  // host:port of the server
  Credentials credentials = {};
  // Of calls that name none. They wait for the link to come up, within this time; kUnavailable if
  // it has not, kDeadlineExceeded if the answer has not come over it.
  absl::Duration call_timeout = absl::Seconds(10);
  absl::Duration stream_open_timeout = absl::Seconds(5);
  absl::Duration stream_write_timeout = absl::Seconds(10);  // a server that stops reading is gone
};

// A connection to a server, opened at the first call and again whenever it breaks. Clients may
// share one; each keeps it alive. See client/grpc_link.h.
class GrpcLink;
std::shared_ptr<GrpcLink> MakeGrpcLink(const GrpcClientOptions& options);

}  // namespace plumescout::client
