// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/mission/mission.h"
#include "core/types/options.h"
#include "core/types/stop.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// A mission's state, packed. `state`: of Mission::SaveState, at this revision.
StoredSnapshot PackSnapshot(std::int64_t revision, std::uint64_t digest, absl::string_view state);

// The mission of a snapshot. kDataLoss if its bytes are damaged, or if the mission that they make
// is not the one that was packed; else as Mission::Restore.
absl::StatusOr<std::unique_ptr<Mission>> RestoreSnapshot(const StoredSnapshot& snapshot,
                                                         const MissionOptions& options,
                                                         const StopFn& stop);

}  // namespace plumescout::server
