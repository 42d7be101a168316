// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/grpc_status.h"

#include <gtest/gtest.h>

#include "proto/convert/field.h"
#include "proto/convert/status.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace grpc_status_test {

absl::Status Details(const grpc::Status& status) {
  google::rpc::Status proto;
  EXPECT_TRUE(proto.ParseFromString(status.error_details()));
  return FromProto(proto);
}

TEST(GrpcStatusTest, CodeMessageAndDetailsGoOver) {
  const grpc::Status status = ToGrpc(FieldError("pose", "must be set"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(), "pose must be set");
  EXPECT_EQ(FieldViolations(Details(status)).at(0).field, "pose");
}

TEST(GrpcStatusTest, EveryErrorHasAReason) {
  for (int code = 1; code <= 16; ++code) {
    const absl::Status status(static_cast<absl::StatusCode>(code), "x");
    EXPECT_FALSE(Reason(Details(ToGrpc(status))).empty()) << code;
    EXPECT_EQ(static_cast<int>(ToGrpc(status).error_code()), code);
  }
}

TEST(GrpcStatusTest, WhoCallsAServerThatWasOvertakenComesAgain) {
  const grpc::Status status =
      ToGrpc(TypedError(absl::StatusCode::kFailedPrecondition, reason::kFenced, "x"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(status.error_message(), "FENCED: x");
  EXPECT_EQ(Reason(Details(status)), reason::kFenced);
}

TEST(GrpcStatusTest, RequestIsNamedIfItHasAnId) {
  const absl::Status status = absl::NotFoundError("x");
  EXPECT_EQ(RequestId(Details(ToGrpc(status, "r7"))), "r7");
  EXPECT_EQ(RequestId(Details(ToGrpc(status))), "");
}

TEST(GrpcStatusTest, OkIsOk) { EXPECT_TRUE(ToGrpc(absl::OkStatus()).ok()); }

}  // namespace grpc_status_test
}  // namespace plumescout::server
