// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/status.h>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace plumescout::client {

// The absl::Status that the server had, with its google.rpc details as payloads; the message begins
// with the reason of a typed error.
absl::Status FromGrpc(const grpc::Status& status);

// It is the server, not the caller, who is to blame for an answer that cannot be read.
template <typename T>
absl::StatusOr<T> FromServer(absl::StatusOr<T> read) {
  if (read.ok()) return read;
  return absl::InternalError(read.status().message());
}

}  // namespace plumescout::client
