// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "google/protobuf/message.h"
#include "google/rpc/status.pb.h"

namespace plumescout {

// Error details travel in the payloads of an absl::Status, one a type of google.rpc message, so
// that a status converts to google.rpc.Status and back without loss.

// The domain of every ErrorInfo of ours.
inline constexpr char kErrorDomain[] = "plumescout.v1";

// Sets the payload of the detail's type.
void AttachDetail(const google::protobuf::Message& detail, absl::Status& status);

// ErrorInfo: a reason in UPPER_SNAKE that programs may act on, with facts by name.
absl::Status WithReason(absl::Status status, absl::string_view reason,
                        const std::map<std::string, std::string>& metadata = {});
// RequestInfo: the number under which logs tell of the request.
absl::Status WithRequestId(absl::Status status, absl::string_view request_id);
// RetryInfo: not before this long from now.
absl::Status WithRetryDelay(absl::Status status, absl::Duration delay);

struct FieldViolation {
  std::string field;
  std::string description;

  friend bool operator==(const FieldViolation&, const FieldViolation&) = default;
};

// What a status carries; empty if nothing (or nothing readable) is attached.
std::string Reason(const absl::Status& status);
std::string RequestId(const absl::Status& status);
std::map<std::string, std::string> ReasonMetadata(const absl::Status& status);
std::optional<absl::Duration> RetryDelay(const absl::Status& status);
std::vector<FieldViolation> FieldViolations(const absl::Status& status);

google::rpc::Status ToProto(const absl::Status& status);
// Codes that gRPC does not know become kUnknown.
absl::Status FromProto(const google::rpc::Status& proto);

}  // namespace plumescout
