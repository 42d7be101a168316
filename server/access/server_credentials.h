// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "absl/status/statusor.h"
#include "server/config/config.h"

namespace plumescout::server {

// Plaintext, or TLS from 1.2 by the files that `config` names, which are read again when they
// change. Files that are missing, do not fit together or hold something else are refused here:
// later they would fail every handshake, without a word.
absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeServerCredentials(
    const AccessConfig& config);

}  // namespace plumescout::server
