// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/status.h>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {

// The one translation from our errors to gRPC's: the same code and message, and google.rpc.Status
// details with at least an ErrorInfo, and a RequestInfo if the request has an id.
grpc::Status ToGrpc(const absl::Status& status, absl::string_view request_id = "");

}  // namespace plumescout::server
