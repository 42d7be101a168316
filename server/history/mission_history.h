// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "absl/status/statusor.h"
#include "core/types/ids.h"
#include "core/types/stop.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Which events are wanted.
struct HistoryPage {
  std::int64_t first_number = 1;
  int size = 100;
  std::set<int> kinds;  // v1::MissionEventKind; empty: all
};

// kInvalidArgument naming the field. A token is of any list of the mission: it is a number.
absl::StatusOr<HistoryPage> HistoryPageFromProto(const v1::GetMissionHistoryRequest& request);

// Looks at no more events than this for one page, so that a rare kind costs many short calls
// instead of a long one.
inline constexpr int kMaxEventsLookedAt = 20'000;

// The page of a stored mission; what is not durable is not in it. kNotFound; kDataLoss if a record
// is damaged; kCancelled. Reads at most kMaxEventsLookedAt records: not for reactors.
absl::StatusOr<v1::GetMissionHistoryResponse> ReadHistory(MissionStore& store,
                                                          const std::string& key,
                                                          const MissionId& mission,
                                                          const HistoryPage& page,
                                                          const StopFn& stop);

}  // namespace plumescout::server
