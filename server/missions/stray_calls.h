// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {

// How things stand with calls that strayed.
struct StrayFigures {
  std::int64_t calls = 0;                   // that strayed and came to this node
  std::int64_t given_up = 0;                // missions of this node, since theirs went to others
  std::vector<std::string> unreached = {};  // living nodes that calls did not find lately
};

// Calls that named another node, as the one that has their mission, and came to this one: whoever
// leads calls to nodes does not reach that node. It is told so by way of the store, and gives the
// mission up. Thread-safe.
class StrayCalls {
 public:
  using GiveUp = std::function<absl::Status(const StrayMission&)>;

  // `nodes` null: there are no others. `give_up` may block.
  StrayCalls(StoreNodes* nodes, GiveUp give_up) : nodes_(nodes), give_up_(std::move(give_up)) {}

  // A call for the mission, which this node has, strayed. Does not block.
  void Note(const OwnedMission& mission);
  // Tells the store of those, and gives up what others have told of. Called about once a second.
  // Blocks.
  void Follow();
  StrayFigures figures() const;

 private:
  static constexpr std::size_t kMaxMissions = 4096;  // noted at once
  static constexpr int kGivenUpAtOnce = 64;

  absl::Status Tell();
  absl::StatusOr<Strays> Exchange();

  StoreNodes* const nodes_;
  const GiveUp give_up_;

  mutable absl::Mutex mutex_;
  std::map<std::string, std::string> nodes_by_key_ ABSL_GUARDED_BY(mutex_);  // since Follow
  StrayFigures figures_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
