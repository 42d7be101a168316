// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_status.h"

#include <gtest/gtest.h>

#include <string>

#include "client/error_reason.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace grpc_status_test {

grpc::Status WithDetails(grpc::StatusCode code, const absl::Status& details) {
  return {code, std::string(details.message()), ToProto(details).SerializeAsString()};
}

TEST(GrpcStatusTest, SuccessIsOk) { EXPECT_EQ(FromGrpc(grpc::Status::OK), absl::OkStatus()); }

TEST(GrpcStatusTest, APlainErrorKeepsItsCodeAndMessage) {
  EXPECT_EQ(FromGrpc({grpc::StatusCode::UNAVAILABLE, "failed to connect"}),
            absl::UnavailableError("failed to connect"));
  EXPECT_EQ(FromGrpc({grpc::StatusCode::UNAUTHENTICATED, ""}), absl::UnauthenticatedError(""));
}

TEST(GrpcStatusTest, ATypedErrorKeepsItsDetails) {
  const absl::Status sent = WithReason(absl::FailedPreconditionError("SEQUENCE_GAP: expected 7"),
                                       "SEQUENCE_GAP", {{"expected_sequence", "7"}});

  const absl::Status status = FromGrpc(WithDetails(grpc::StatusCode::FAILED_PRECONDITION, sent));

  EXPECT_EQ(status, sent);
  EXPECT_EQ(ErrorReason(status), kSequenceGap);
  EXPECT_EQ(ReasonMetadata(status).at("expected_sequence"), "7");
}

TEST(GrpcStatusTest, DetailsOfAnotherErrorAreNotBelieved) {
  const grpc::Status contradictory(
      grpc::StatusCode::UNAVAILABLE, "going away",
      ToProto(absl::NotFoundError("no such thing")).SerializeAsString());

  EXPECT_EQ(FromGrpc(contradictory), absl::UnavailableError("going away"));
}

TEST(GrpcStatusTest, DetailsThatCannotBeReadAreNotBelieved) {
  EXPECT_EQ(FromGrpc({grpc::StatusCode::INTERNAL, "broken", "\xff\xff\xff"}),
            absl::InternalError("broken"));
}

}  // namespace grpc_status_test
}  // namespace plumescout::client
