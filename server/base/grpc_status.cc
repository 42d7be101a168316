// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/grpc_status.h"

#include <string>
#include <utility>

#include "proto/convert/status.h"
#include "server/base/errors.h"

namespace plumescout::server {

grpc::Status ToGrpc(const absl::Status& status, absl::string_view request_id) {
  if (status.ok()) return grpc::Status::OK;
  absl::Status told = WithErrorInfo(status);
  if (!request_id.empty()) told = WithRequestId(std::move(told), request_id);
  return {static_cast<grpc::StatusCode>(status.code()), std::string(status.message()),
          ToProto(told).SerializeAsString()};
}

}  // namespace plumescout::server
