// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_status.h"

#include "google/rpc/status.pb.h"
#include "proto/convert/status.h"

namespace plumescout::client {

absl::Status FromGrpc(const grpc::Status& status) {
  if (status.ok()) return absl::OkStatus();
  google::rpc::Status details;
  const bool typed = !status.error_details().empty() &&
                     details.ParseFromString(status.error_details()) &&
                     details.code() == static_cast<int>(status.error_code());
  if (typed) return FromProto(details);
  return {static_cast<absl::StatusCode>(status.error_code()), status.error_message()};
}

}  // namespace plumescout::client
