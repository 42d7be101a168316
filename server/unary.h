// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include "absl/status/status.h"
#include "server/grpc_status.h"

namespace plumescout::server {

// Answers a unary call, now or later and from any thread, exactly once.
inline void Answer(grpc::ServerUnaryReactor* call, const absl::Status& status) {
  call->Finish(ToGrpc(status));
}

}  // namespace plumescout::server
