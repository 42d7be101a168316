// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/base/clock.h"

namespace plumescout::server {

// A server of several that share one store.
struct StoreNode {
  std::string name;     // one word, of the operator's choice; clients ask for a node by it
  std::string address;  // where it listens, for those who look

  friend bool operator==(const StoreNode&, const StoreNode&) = default;
};

// A mission of the store, and the living node that has it; empty: nobody's.
struct OwnedMission {
  std::string key;
  std::string node;
  std::string damage = {};  // what is wrong with it, as a node has found; empty: nothing is known

  friend bool operator==(const OwnedMission&, const OwnedMission&) = default;
};

// Which missions to list: at most `limit`, in order of key.
struct OwnedMissionQuery {
  std::string after = {};        // keys after this one
  std::string begins_with = {};  // that begin so
  std::string last_part = {};    // whose part after the last slash is this; empty: any
  int limit = 0;
};

// A mission that is to go if nobody calls for it any more, whoever has it by then.
struct KeptMission {
  std::string key;
  absl::Duration keep_for;  // from now on; infinite: for good
};

// A mission of nobody that has outlived its use.
struct ForgottenMission {
  std::string key;
  std::int64_t epoch = 0;

  friend bool operator==(const ForgottenMission&, const ForgottenMission&) = default;
};

// A mission of this node whose calls have come to another one for long enough (StoreNodes).
struct StrayMission {
  std::string key;
  std::int64_t epoch = 0;
  std::string came_to;  // that node

  friend bool operator==(const StrayMission&, const StrayMission&) = default;
};

// When calls that come to the wrong node move their mission there. Clients that are not served come
// again after waits that grow to some seconds.
struct StrayRules {
  absl::Duration lasts = absl::Seconds(3);   // calls have strayed for so long
  absl::Duration gap = absl::Seconds(15);    // without a longer one between them
  absl::Duration rests = absl::Seconds(10);  // after it has moved it stays for so long
  absl::Duration shown = absl::Minutes(2);   // a node is called unreached for so long
};

// What the store has heard of calls that strayed.
struct Strays {
  std::vector<StrayMission> missions;  // to be given up; each is told of once until it has rested
  std::vector<std::string> unreached;  // living nodes that calls did not find lately, by name
};

// The servers that share a store, and which of them has which mission. A node holds one lease in
// the store, by the clock of the store alone, and every mission that it acquires (MissionStore)
// is its own until it gives it back or its lease runs out. Safety rests on epochs, not on leases:
// whoever lost a mission is FENCED. Thread-safe; what blocks says so.
class StoreNodes {
 public:
  using OnLost = std::function<void(const absl::Status&)>;

  virtual ~StoreNodes() = default;

  virtual const StoreNode& self() const = 0;

  // Until when this node may answer for its missions: counted from before the renewal was sent, by
  // the steady clock. In the past once the lease was lost.
  virtual SteadyTime lease_until() const = 0;
  // OK while the lease holds; else why not, for people.
  virtual absl::Status status() const = 0;
  // Called when the lease is lost, on a thread of the store's, and must not block; the node then
  // joins again by itself, under another lease, and has no missions.
  virtual void SetOnLost(OnLost on_lost) = 0;

  // Nodes whose lease holds, by name. Blocks.
  virtual absl::StatusOr<std::vector<StoreNode>> ListLiving() = 0;
  // The living node whose mission it is; nothing if it is nobody's. kNotFound if the store has no
  // such mission. Blocks.
  virtual absl::StatusOr<std::optional<std::string>> FindOwner(const std::string& key) = 0;
  // Blocks.
  virtual absl::StatusOr<std::vector<OwnedMission>> ListMissions(
      const OwnedMissionQuery& query) = 0;
  // Tells who lists the mission, until somebody has acquired it, what is wrong with it. Blocks.
  virtual absl::Status NoteDamage(const std::string& key, const std::string& what) = 0;
  // Of missions of this node; others are passed over. Who acquires a mission forgets how long it
  // was to be kept. Blocks.
  virtual absl::Status KeepFor(const std::vector<KeptMission>& missions) = 0;
  // At most `limit`, those first that are over for longest. Blocks.
  virtual absl::StatusOr<std::vector<ForgottenMission>> ListForgotten(int limit) = 0;
  // Calls for these missions named the nodes that have them, and came to this one. Those that are
  // not these nodes' are passed over. Blocks.
  virtual absl::Status NoteStrays(const std::vector<OwnedMission>& missions) = 0;
  // What nodes have noted so; at most `limit` missions. Blocks.
  virtual absl::StatusOr<Strays> TakeStrays(int limit) = 0;
  // The mission is nobody's: the next who acquires it has it. FENCED if it is not of this epoch.
  // Blocks.
  virtual absl::Status Release(const std::string& key, std::int64_t epoch) = 0;
};

}  // namespace plumescout::server
