// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/grpc_status.h"

#include <string>

#include "proto/convert/status.h"
#include "server/base/errors.h"

namespace plumescout::server {

grpc::Status ToGrpc(const absl::Status& status) {
  if (status.ok()) return grpc::Status::OK;
  return {static_cast<grpc::StatusCode>(status.code()), std::string(status.message()),
          ToProto(WithErrorInfo(status)).SerializeAsString()};
}

}  // namespace plumescout::server
