// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What missions are saved as: their state, and how they stand.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "absl/strings/string_view.h"
#include "core/mission/mission.h"
#include "server/missions/standing_record.h"
#include "tests/fuzz/small_mission.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto standing = plumescout::server::DecodeStanding(bytes);
  if (standing.ok()) {
    const std::string encoded = plumescout::server::EncodeStanding(*standing);
    const auto again = plumescout::server::DecodeStanding(encoded);
    if (!again.ok() || *again != *standing) std::abort();
  }
  // What makes a mission can be saved again.
  const auto mission = plumescout::Mission::Restore(plumescout::fuzz::SmallMission(), bytes);
  if (mission.ok()) {
    (*mission)->Snapshot();
    if (!(*mission)->SaveState().ok()) std::abort();
  }
  return 0;
}
