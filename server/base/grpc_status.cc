// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/grpc_status.h"

#include <string>
#include <utility>

#include "core/types/error_reason.h"
#include "proto/convert/status.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

// It is the server that was overtaken: who calls finds the mission elsewhere, or here again.
absl::Status ForCallers(const absl::Status& status) {
  if (ErrorReason(status) != reason::kFenced) return status;
  return {absl::StatusCode::kUnavailable, status.message()};  // the message begins with the reason
}

}  // namespace

grpc::Status ToGrpc(const absl::Status& status, absl::string_view request_id) {
  if (status.ok()) return grpc::Status::OK;
  absl::Status told = WithErrorInfo(ForCallers(status));
  if (!request_id.empty()) told = WithRequestId(std::move(told), request_id);
  std::string details = ToProto(told).SerializeAsString();
  return {static_cast<grpc::StatusCode>(told.code()), std::string(told.message()),
          std::move(details)};
}

}  // namespace plumescout::server
