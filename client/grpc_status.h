// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/status.h>

#include "absl/status/status.h"

namespace plumescout::client {

// The absl::Status that the server had, with its google.rpc details as payloads; the message begins
// with the reason of a typed error.
absl::Status FromGrpc(const grpc::Status& status);

}  // namespace plumescout::client
