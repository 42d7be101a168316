// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/call_metrics.h"

#include <cstddef>

#include "core/types/error_reason.h"
#include "server/observe/buckets.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kMaxReasons = 32;

prometheus::Labels LabelsOf(Rpc rpc) {
  const RpcRow& row = RowOf(rpc);
  return {{"service", std::string(row.service)}, {"method", std::string(row.method)}};
}

prometheus::Labels LabelsOf(Rpc rpc, absl::StatusCode code) {
  prometheus::Labels labels = LabelsOf(rpc);
  labels["code"] = absl::StatusCodeToString(code);
  return labels;
}

}  // namespace

CallMetrics::CallMetrics(prometheus::Registry& registry)
    : calls_(prometheus::BuildCounter()
                 .Name("plumescout_rpc_calls_total")
                 .Help("Calls and streams that have ended, by gRPC code.")
                 .Register(registry)),
      durations_(prometheus::BuildHistogram()
                     .Name("plumescout_rpc_duration_seconds")
                     .Help("Time from the arrival of a call to its answer, of a stream to its end.")
                     .Register(registry)),
      refusals_(prometheus::BuildCounter()
                    .Name("plumescout_rpc_refusals_total")
                    .Help("Calls and streams refused with RESOURCE_EXHAUSTED, by reason.")
                    .Register(registry)) {
  for (const RpcRow& row : RpcTable()) {
    const auto index = static_cast<std::size_t>(row.rpc);
    ok_[index] = &calls_.Add(LabelsOf(row.rpc, absl::StatusCode::kOk));
    duration_[index] = &durations_.Add(LabelsOf(row.rpc), DurationBuckets_s());
  }
  refusals_.Add({{"reason", Bounded(reason::kOverloaded)}});
}

void CallMetrics::Note(Rpc rpc, const absl::Status& status, absl::Duration duration) {
  const auto index = static_cast<std::size_t>(rpc);
  duration_[index]->Observe(absl::ToDoubleSeconds(duration));
  if (status.ok()) return ok_[index]->Increment();
  calls_.Add(LabelsOf(rpc, status.code())).Increment();
  if (absl::IsResourceExhausted(status)) {
    refusals_.Add({{"reason", Bounded(ErrorReason(status))}}).Increment();
  }
}

std::string CallMetrics::Bounded(absl::string_view reason) {
  absl::MutexLock lock(&mutex_);
  std::string text(reason);
  const bool known = reasons_.count(text) > 0;
  if (text.empty() || (!known && reasons_.size() >= kMaxReasons)) return "OTHER";
  reasons_.insert(text);
  return text;
}

}  // namespace plumescout::server
