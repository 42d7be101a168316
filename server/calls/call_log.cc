// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/call_log.h"

#include <cstddef>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

constexpr std::array<absl::string_view, kStageNames.size()> kStageFields = {
    "belief_ms", "queue_ms", "search_ms", "commit_ms", "read_ms", "durable_ms"};

std::string Milliseconds(absl::Duration time) {
  return absl::StrCat(absl::ToInt64Milliseconds(time));
}

bool LastsAsItLikes(Rpc rpc) {
  return rpc == Rpc::kStreamObservations || rpc == Rpc::kWatchMap || rpc == Rpc::kWatchRobot;
}

bool IsOurFault(absl::StatusCode code) {
  return code == absl::StatusCode::kInternal || code == absl::StatusCode::kUnknown ||
         code == absl::StatusCode::kDataLoss;
}

}  // namespace

void CallLog::Note(const CallInfo& info, const CallEnd& end) const {
  const bool slow = end.duration > slow_after_ && !LastsAsItLikes(info.rpc);
  const bool failed = IsOurFault(end.status.code());
  const LogLevel level = failed ? LogLevel::kError : slow ? LogLevel::kWarning : LogLevel::kDebug;
  if (!IsLogged(level)) return;
  const RpcRow& row = RowOf(info.rpc);
  std::vector<LogField> fields = {{"method", absl::StrCat(row.service, "/", row.method)},
                                  {"caller", info.caller.name},
                                  {"code", absl::StatusCodeToString(end.status.code())},
                                  {"duration_ms", Milliseconds(end.duration)}};
  for (std::size_t i = 0; i < kStageFields.size(); ++i) {
    const absl::Duration time = info.stage_times->Of(static_cast<Stage>(i));
    if (time > absl::ZeroDuration()) fields.push_back({kStageFields[i], Milliseconds(time)});
  }
  if (!end.status.ok()) fields.push_back({"why", std::string(end.status.message())});
  fields.push_back({"request_id", info.request_id});
  Log(level, failed ? "call failed" : slow ? "slow call" : "call", fields);
}

}  // namespace plumescout::server
