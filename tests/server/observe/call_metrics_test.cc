// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/call_metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include <string>

#include "absl/strings/str_cat.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace call_metrics_test {

using ::testing::HasSubstr;

std::string TextOf(const prometheus::Registry& registry) {
  return prometheus::TextSerializer().Serialize(registry.Collect());
}

TEST(CallMetricsTest, CallsAreCountedByMethodAndCode) {
  prometheus::Registry registry;
  CallMetrics metrics(registry);
  metrics.Note(Rpc::kGetMap, absl::OkStatus(), absl::Milliseconds(3));
  metrics.Note(Rpc::kGetMap, absl::OkStatus(), absl::Seconds(2));
  metrics.Note(Rpc::kGetMap, absl::NotFoundError("x"), absl::Milliseconds(1));
  const std::string text = TextOf(registry);
  const std::string calls = "plumescout_rpc_calls_total{code=";
  EXPECT_THAT(text, HasSubstr(calls + R"("OK",method="GetMap",service="MapService"} 2)"));
  EXPECT_THAT(text, HasSubstr(calls + R"("NOT_FOUND",method="GetMap",service="MapService"} 1)"));
  // Methods that were never called are there too.
  EXPECT_THAT(text, HasSubstr(calls + R"("OK",method="QueryGas",service="MapService"} 0)"));
  const std::string times = R"({method="GetMap",service="MapService")";
  EXPECT_THAT(text, HasSubstr("plumescout_rpc_duration_seconds_count" + times + "} 3"));
  EXPECT_THAT(text, HasSubstr("plumescout_rpc_duration_seconds_bucket" + times + R"(,le="1"} 2)"));
}

TEST(CallMetricsTest, RefusalsAreCountedByReason) {
  prometheus::Registry registry;
  CallMetrics metrics(registry);
  metrics.Note(Rpc::kGetMap, Overloaded("x"), absl::Milliseconds(1));
  metrics.Note(Rpc::kGetMap, LimitReached("x"), absl::Milliseconds(1));
  metrics.Note(Rpc::kGetMap, absl::ResourceExhaustedError("by gRPC"), absl::Milliseconds(1));
  const std::string text = TextOf(registry);
  for (const char* reason : {"OVERLOADED", "LIMIT_REACHED", "OTHER"}) {
    EXPECT_THAT(text, HasSubstr(absl::StrCat("plumescout_rpc_refusals_total{reason=\"", reason,
                                             "\"} 1\n")));
  }
}

TEST(CallMetricsTest, ReasonsAreBounded) {
  prometheus::Registry registry;
  CallMetrics metrics(registry);
  for (int i = 0; i < 1000; ++i) {
    const std::string reason = "REASON_" + std::string(static_cast<std::size_t>(i), 'X');
    metrics.Note(Rpc::kGetMap, absl::ResourceExhaustedError(reason + ": x"), absl::Seconds(1));
  }
  const std::string text = TextOf(registry);
  int series = 0;
  const std::string name = "\nplumescout_rpc_refusals_total{";
  for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; ++at) ++series;
  EXPECT_GT(series, 10);
  EXPECT_LT(series, 40);
}

}  // namespace call_metrics_test
}  // namespace plumescout::server
