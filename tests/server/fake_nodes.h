// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "server/store/store_errors.h"
#include "server/store/store_nodes.h"
#include "tests/server/held_store.h"

namespace plumescout::server {

// A store that is shared with servers that are not there. Thread-safe.
class SharedStore : public HeldStore, public StoreNodes {
 public:
  // From now on the mission is this living node's; of nobody if it is empty.
  void SetOwner(const std::string& key, const std::string& node) {
    absl::MutexLock lock(&nodes_mutex_);
    owners_[key] = node;
  }
  // Another server, which lives.
  void AddNode(const std::string& name) {
    absl::MutexLock lock(&nodes_mutex_);
    living_.push_back({name, "127.0.0.1:2"});
  }
  void SetLeaseUntil(SteadyTime until) {
    absl::MutexLock lock(&nodes_mutex_);
    lease_until_ = until;
  }
  void LoseLease() {
    OnLost on_lost;
    {
      absl::MutexLock lock(&nodes_mutex_);
      on_lost = on_lost_;
    }
    if (on_lost) on_lost(absl::UnavailableError("lost"));
  }
  // Missions that ListForgotten tells of, until somebody acquires or removes them.
  void SetForgotten(std::vector<ForgottenMission> forgotten) {
    absl::MutexLock lock(&nodes_mutex_);
    forgotten_ = std::move(forgotten);
  }
  std::map<std::string, absl::Duration> kept() const {
    absl::MutexLock lock(&nodes_mutex_);
    return kept_;
  }
  // What TakeStrays tells next, once.
  void SetStrays(Strays strays) {
    absl::MutexLock lock(&nodes_mutex_);
    strays_ = std::move(strays);
  }
  std::vector<OwnedMission> noted_strays() const {
    absl::MutexLock lock(&nodes_mutex_);
    return noted_strays_;
  }
  std::map<std::string, std::int64_t> released() const {
    absl::MutexLock lock(&nodes_mutex_);
    return released_;
  }

  absl::StatusOr<AcquiredMission> Acquire(const std::string& key) override {
    const auto owner = FindOwner(key);
    if (owner.ok() && owner->has_value()) return MissionElsewhere(key, **owner);
    return HeldStore::Acquire(key);
  }
  StoreNodes* nodes() override { return this; }

  const StoreNode& self() const override { return self_; }
  SteadyTime lease_until() const override {
    absl::MutexLock lock(&nodes_mutex_);
    return lease_until_;
  }
  absl::Status status() const override { return absl::OkStatus(); }
  void SetOnLost(OnLost on_lost) override {
    absl::MutexLock lock(&nodes_mutex_);
    on_lost_ = std::move(on_lost);
  }
  absl::StatusOr<std::vector<StoreNode>> ListLiving() override {
    absl::MutexLock lock(&nodes_mutex_);
    return living_;
  }
  absl::StatusOr<std::optional<std::string>> FindOwner(const std::string& key) override {
    absl::MutexLock lock(&nodes_mutex_);
    const auto found = owners_.find(key);
    if (found == owners_.end() || found->second.empty()) return std::nullopt;
    return found->second;
  }
  absl::StatusOr<std::vector<OwnedMission>> ListMissions(const OwnedMissionQuery& query) override {
    const auto stored = List();
    if (!stored.ok()) return stored.status();
    std::vector<OwnedMission> missions;
    absl::MutexLock lock(&nodes_mutex_);
    for (const StoredMission& mission : *stored) {
      const std::string last_part = mission.key.substr(mission.key.rfind('/') + 1);
      const bool is_wanted = mission.key > query.after &&
                             mission.key.starts_with(query.begins_with) &&
                             (query.last_part.empty() || query.last_part == last_part);
      if (!is_wanted || static_cast<int>(missions.size()) == query.limit) continue;
      const auto owner = owners_.find(mission.key);
      const auto damage = damages_.find(mission.key);
      missions.push_back({mission.key, owner == owners_.end() ? "" : owner->second,
                          damage == damages_.end() ? "" : damage->second});
    }
    return missions;
  }
  absl::Status NoteDamage(const std::string& key, const std::string& what) override {
    absl::MutexLock lock(&nodes_mutex_);
    damages_[key] = what;
    return absl::OkStatus();
  }
  absl::Status KeepFor(const std::vector<KeptMission>& missions) override {
    absl::MutexLock lock(&nodes_mutex_);
    for (const KeptMission& mission : missions) kept_[mission.key] = mission.keep_for;
    return absl::OkStatus();
  }
  absl::StatusOr<std::vector<ForgottenMission>> ListForgotten(int) override {
    absl::MutexLock lock(&nodes_mutex_);
    return forgotten_;
  }
  absl::Status NoteStrays(const std::vector<OwnedMission>& missions) override {
    absl::MutexLock lock(&nodes_mutex_);
    noted_strays_.insert(noted_strays_.end(), missions.begin(), missions.end());
    return absl::OkStatus();
  }
  absl::StatusOr<Strays> TakeStrays(int) override {
    absl::MutexLock lock(&nodes_mutex_);
    return std::exchange(strays_, {{}, strays_.unreached});
  }
  absl::Status Release(const std::string& key, std::int64_t epoch) override {
    absl::MutexLock lock(&nodes_mutex_);
    released_[key] = epoch;
    return absl::OkStatus();
  }

 private:
  const StoreNode self_ = {"n1", "127.0.0.1:1"};
  mutable absl::Mutex nodes_mutex_;
  std::map<std::string, std::string> owners_ ABSL_GUARDED_BY(nodes_mutex_);
  std::map<std::string, std::string> damages_ ABSL_GUARDED_BY(nodes_mutex_);
  std::vector<StoreNode> living_ ABSL_GUARDED_BY(nodes_mutex_) = {self_};
  std::vector<ForgottenMission> forgotten_ ABSL_GUARDED_BY(nodes_mutex_);
  std::map<std::string, absl::Duration> kept_ ABSL_GUARDED_BY(nodes_mutex_);
  std::map<std::string, std::int64_t> released_ ABSL_GUARDED_BY(nodes_mutex_);
  Strays strays_ ABSL_GUARDED_BY(nodes_mutex_);
  std::vector<OwnedMission> noted_strays_ ABSL_GUARDED_BY(nodes_mutex_);
  SteadyTime lease_until_ ABSL_GUARDED_BY(nodes_mutex_) = SteadyTime::max();
  OnLost on_lost_ ABSL_GUARDED_BY(nodes_mutex_);
};

}  // namespace plumescout::server
