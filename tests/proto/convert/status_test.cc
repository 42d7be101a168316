// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/convert/field.h"

namespace plumescout {
namespace status_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(StatusTest, EveryDetailSurvivesTheWire) {
  absl::Status status = FieldError("pose", "must be set");
  status = WithReason(status, "BAD_POSE", {{"robot", "r1"}});
  status = WithRetryDelay(status, absl::Milliseconds(1250));
  status = WithRequestId(status, "r7");

  const absl::Status back = FromProto(ToProto(status));

  EXPECT_EQ(back, status);
  EXPECT_EQ(Reason(back), "BAD_POSE");
  EXPECT_THAT(ReasonMetadata(back), ElementsAre(Pair("robot", "r1")));
  EXPECT_EQ(RetryDelay(back), absl::Milliseconds(1250));
  EXPECT_EQ(RequestId(back), "r7");
  EXPECT_THAT(FieldViolations(back), ElementsAre(FieldViolation{"pose", "must be set"}));
}

TEST(StatusTest, PlainStatusCarriesNothing) {
  const absl::Status status = absl::NotFoundError("gone");
  EXPECT_EQ(Reason(status), "");
  EXPECT_EQ(RetryDelay(status), std::nullopt);
  EXPECT_THAT(ReasonMetadata(status), IsEmpty());
  EXPECT_THAT(FieldViolations(status), IsEmpty());
}

TEST(StatusTest, UnknownCodesBecomeUnknown) {
  google::rpc::Status proto;
  for (const int code : {-1, 17, 1000}) {
    proto.set_code(code);
    EXPECT_TRUE(absl::IsUnknown(FromProto(proto))) << code;
  }
  proto.set_code(0);
  EXPECT_TRUE(FromProto(proto).ok());
}

TEST(StatusTest, UnreadableDetailsCountAsNone) {
  absl::Status status = absl::AbortedError("x");
  status.SetPayload("type.googleapis.com/google.rpc.ErrorInfo", absl::Cord("\xff\xff\xff"));
  EXPECT_EQ(Reason(status), "");
}

TEST(StatusTest, ReasonsOfOtherDomainsAreNotOurs) {
  google::rpc::Status proto = ToProto(WithReason(absl::AbortedError("x"), "OURS"));
  std::string& value = *proto.mutable_details(0)->mutable_value();
  value.replace(value.find("plumescout.v1"), 13, "another.domai");
  EXPECT_EQ(Reason(FromProto(proto)), "");
}

}  // namespace status_test
}  // namespace plumescout
