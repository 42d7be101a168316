// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// A mission as bytes: version of the format, the state, a hash of both.

#include "core/mission/mission.h"

#include <cstring>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/gas/gas_state.h"
#include "core/gas/way_state.h"
#include "core/mission/fleet_state.h"
#include "core/mission/goal_memory_state.h"
#include "core/mission/way_history_state.h"
#include "core/occupancy/occupancy_state.h"
#include "core/types/byte_archive.h"
#include "core/types/byte_reader.h"
#include "core/types/keep_out.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Of what SaveState writes. Who changes that counts it up, and reads the old one on.
constexpr std::uint32_t kStateVersion = 5;
constexpr std::uint32_t kOldestStateVersion = 1;
constexpr std::uint32_t kVersionWithHistory = 2;

std::uint64_t HashOf(absl::string_view bytes) {
  Hash64 hash;
  hash.Add(bytes);
  return hash.value();
}

// What stands between version and hash. Every version has both in these places.
struct Unframed {
  std::uint32_t version = 0;
  absl::string_view state;
};
absl::StatusOr<Unframed> Unframe(absl::string_view bytes) {
  std::uint32_t version = 0;
  std::uint64_t hash = 0;
  if (bytes.size() < sizeof(version) + sizeof(hash)) {
    return absl::DataLossError(
        absl::StrCat("the state of a mission ends after ", bytes.size(), " bytes"));
  }
  const absl::string_view hashed = bytes.substr(0, bytes.size() - sizeof(hash));
  std::memcpy(&hash, bytes.data() + hashed.size(), sizeof(hash));
  if (hash != HashOf(hashed)) {
    return absl::DataLossError("the state of a mission is damaged: its hash is another");
  }
  std::memcpy(&version, hashed.data(), sizeof(version));
  if (version < kOldestStateVersion || version > kStateVersion) {
    return absl::FailedPreconditionError(absl::StrCat("the state of a mission is of version ",
                                                      version, "; known are ", kOldestStateVersion,
                                                      " to ", kStateVersion));
  }
  return Unframed{version, hashed.substr(sizeof(version))};
}

}  // namespace

constexpr bool IsOne(ObjectiveState state) {
  switch (state) {
    case ObjectiveState::kPursued:
    case ObjectiveState::kMet:
    case ObjectiveState::kRefuted:
    case ObjectiveState::kCannotBeMet:
      return true;
  }
  return false;
}

void Visit(auto& archive, ConstOr<ObjectiveStatus> auto& status) {
  auto& [state, confidence, undecided_area_m2, open_frontiers, place, mean_ppm, stddev_ppm,
         strongest, since_ns] = status;
  archive(state, confidence, undecided_area_m2, open_frontiers, place, mean_ppm, stddev_ppm,
          strongest, since_ns);
}

template <typename Archive, typename Self>
void Mission::Progress::VisitState(Archive& archive, Self& self) {
  auto& [status, began_ns, assessed_ns, verdict] = self;
  archive(status, began_ns, assessed_ns);
  archive.Since(3, verdict);
}

template <typename Archive, typename Self>
void Mission::VisitState(Archive& archive, Self& self) {
  archive(self.revision_, self.sample_time_ns_, self.posterior_time_ns_, self.refreshed_ns_,
          self.readings_refreshed_ns_, self.map_changed_since_refresh_);
  archive(self.occupancy_, self.region_, self.fleet_, self.goal_memory_,
          self.sampled_cells_.front(), self.gas_);
  if constexpr (Archive::kHashes) {
    // Until something was corrected, or doubted, the history tells nothing more than the rest does,
    // and missions of before it was kept have the hash that they had.
    if (self.history_.was_used()) {
      archive(self.history_, self.jump_watch_, self.map_fault_, self.rebuilt_ns_,
              self.rebuild_ != nullptr);
      if (self.rebuild_ != nullptr) {
        archive(self.rebuild_->time_ns(), self.rebuild_->last_number());
        archive.Since(5, self.rebuild_->fault() == MapFault::kSlight);
      }
    }
  } else {
    archive.Since(2, self.history_, self.jump_watch_, self.map_fault_, self.rebuilt_ns_);
  }
  // Missions of before had no purpose of their own, and those without one have the bytes they had.
  if (self.has_purpose()) archive(self.progress_);
  archive.Since(2, self.changed_keep_out_);
  archive.Since(2, self.lagging_);
  if constexpr (!Archive::kHashes) {
    for (std::size_t i = 1; i < self.sampled_cells_.size(); ++i) {
      archive.Since(2, self.sampled_cells_[i]);
    }
  }
  if constexpr (Archive::kReads) {
    archive.Require(self.goal_memory_.IsOf(self.options_->occupancy.resolution_m),
                    "goals are remembered from another map");
    if (self.changed_keep_out_) {
      archive.Require(ValidateKeepOut(*self.changed_keep_out_).ok(), "a keep-out area is none");
      if (archive.ok()) self.KeepOutOf(*self.changed_keep_out_);
    }
    if (archive.ok()) self.region_.Follow(self.occupancy_.geometry());
  }
}

std::uint64_t Mission::Digest() const {
  StateHasher hasher;
  hasher(*this);
  return hasher.sink().hash.value();
}

absl::StatusOr<std::string> Mission::SaveState() const {
  if (!can_be_saved()) {
    return absl::FailedPreconditionError(
        absl::StrCat("the gas field cannot be made again as it is at revision ", revision_));
  }
  ByteWriter writer;
  writer(kStateVersion, *this);
  std::string& bytes = writer.sink().bytes;
  writer(HashOf(bytes));
  return std::move(bytes);
}

absl::StatusOr<std::unique_ptr<Mission>> Mission::Restore(const MissionOptions& options,
                                                          absl::string_view bytes, StopFn stop) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Unframed unframed, Unframe(bytes));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<Mission> mission, Create(options));
  ByteReader reader(unframed.state, static_cast<std::size_t>(options.memory_budget_bytes),
                    unframed.version);
  reader(*mission);
  if (const absl::Status status = reader.Finish(); !status.ok()) {
    return absl::DataLossError(
        absl::StrCat("the state of a mission is damaged: ", status.message()));
  }
  if (unframed.version < kVersionWithHistory) {
    mission->history_.BeginWith(mission->occupancy_, mission->gas_.first().readings(),
                                mission->sampled_cells_.front(), mission->sample_time_ns_);
  }
  mission->AbandonWhen(std::move(stop));
  PLUMESCOUT_RETURN_IF_ERROR(mission->gas_.MakeFieldsAgain());
  return mission;
}

}  // namespace plumescout
