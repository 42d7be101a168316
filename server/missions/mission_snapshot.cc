// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_snapshot.h"

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/zlib_codec.h"

namespace plumescout::server {
namespace {

constexpr int kFastest = 1;

}  // namespace

StoredSnapshot PackSnapshot(std::int64_t revision, std::uint64_t digest, absl::string_view state) {
  return {revision, digest, CompressZlib(state, kFastest)};
}

absl::StatusOr<std::unique_ptr<Mission>> RestoreSnapshot(const StoredSnapshot& snapshot,
                                                         const MissionOptions& options,
                                                         const StopFn& stop) {
  const auto max_bytes = static_cast<std::uint64_t>(options.memory_budget_bytes);
  auto state = DecompressZlib(snapshot.bytes, max_bytes);
  if (!state.ok()) return absl::DataLossError(state.status().message());
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Restore(options, *state, stop));
  if (mission->revision() != snapshot.revision || mission->Digest() != snapshot.digest) {
    return absl::DataLossError(absl::StrCat("the snapshot of revision ", snapshot.revision,
                                            " makes another mission than it was taken of"));
  }
  return mission;
}

}  // namespace plumescout::server
