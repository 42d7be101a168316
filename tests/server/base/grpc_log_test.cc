// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/grpc_log.h"

#include <gmock/gmock.h>
#include <grpc/support/log.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/server/captured_log.h"

namespace plumescout::server {
namespace grpc_log_test {

using ::testing::ContainsRegex;

TEST(GrpcLogTest, WhatGrpcSaysIsALineOfOurs) {
  TakeGrpcLog();
  gpr_set_log_verbosity(GPR_LOG_SEVERITY_ERROR);  // as gRPC does when it starts
  const std::string log =
      LogOf([] { gpr_log("src/core/a.cc", 7, GPR_LOG_SEVERITY_ERROR, "odd\n%d", 3); });
  EXPECT_THAT(log, ContainsRegex("Z WARNING grpc why=\"odd\\\\n3\" where=a\\.cc:7\n"));
  gpr_set_log_function(nullptr);
}

}  // namespace grpc_log_test
}  // namespace plumescout::server
