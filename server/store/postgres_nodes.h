// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/base/stop_signal.h"
#include "server/store/postgres_connection.h"
#include "server/store/postgres_pool.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {

struct PostgresNodeOptions {
  std::string url;
  std::int64_t store = 0;  // see CheckSameStore
  StoreNode self;
  absl::Duration lease = absl::Seconds(10);
  StrayRules strays;
  // Hears what an operator should know, in a line. Must not block.
  std::function<void(absl::string_view)> warn = [](absl::string_view) {};
};

// The servers that share a database, each a row with the time at which its lease runs out, by the
// clock of the database. A thread renews it four times a lease, over a connection of its own, so
// that no long commit is in its way.
class PostgresNodes final : public StoreNodes {
 public:
  // Joins. Waits for the lease of a node of that name to run out, as a server that was killed
  // leaves one behind. kFailedPrecondition, naming the other's address, if that node lives;
  // kUnavailable.
  static absl::StatusOr<std::unique_ptr<PostgresNodes>> Join(PostgresNodeOptions options,
                                                             std::shared_ptr<PostgresPool> pool);
  // Gives the lease back: what it had is nobody's.
  ~PostgresNodes() override;

  // Under which this node acquires missions; 0 once it is over.
  std::int64_t lease() const;

  const StoreNode& self() const override { return options_.self; }
  SteadyTime lease_until() const override;
  absl::Status status() const override;
  void SetOnLost(OnLost on_lost) override;
  absl::StatusOr<std::vector<StoreNode>> ListLiving() override;
  absl::StatusOr<std::optional<std::string>> FindOwner(const std::string& key) override;
  absl::StatusOr<std::vector<OwnedMission>> ListMissions(const OwnedMissionQuery& query) override;
  absl::Status NoteDamage(const std::string& key, const std::string& what) override;
  absl::Status KeepFor(const std::vector<KeptMission>& missions) override;
  absl::StatusOr<std::vector<ForgottenMission>> ListForgotten(int limit) override;
  absl::Status NoteStrays(const std::vector<OwnedMission>& missions) override;
  absl::StatusOr<Strays> TakeStrays(int limit) override;
  absl::Status Release(const std::string& key, std::int64_t epoch) override;

 private:
  PostgresNodes(PostgresNodeOptions options, std::shared_ptr<PostgresPool> pool);

  // A node of that name, that lives or did until just now.
  struct Holder {
    std::int64_t lease = 0;
    std::int64_t expires_us = 0;
    absl::Duration left;
    std::string address;
  };

  // Nothing: joined. Forgets `old`, a lease of this node's own.
  absl::StatusOr<std::optional<Holder>> TryJoin(std::int64_t old);
  absl::Status JoinAtStart();
  absl::Status Renew();
  // After the lease was lost. If the name is another node's by now, the status says so.
  absl::Status JoinAgain();
  void Lose(const absl::Status& why);
  void Hold(std::int64_t lease, SteadyTime begin);
  absl::Status Connect(SteadyTime limit);
  void Run();
  absl::Duration period() const { return options_.lease / 4; }

  const PostgresNodeOptions options_;
  const std::shared_ptr<PostgresPool> pool_;

  std::unique_ptr<PostgresConnection> connection_;  // of the thread; null after an error
  std::int64_t old_lease_ = 0;  // of the thread: lost, perhaps not forgotten yet

  StopSignal stop_;
  mutable absl::Mutex mutex_;
  std::int64_t lease_ ABSL_GUARDED_BY(mutex_) = 0;
  SteadyTime lease_until_ ABSL_GUARDED_BY(mutex_) = SteadyTime::min();
  absl::Status status_ ABSL_GUARDED_BY(mutex_);

  absl::Mutex on_lost_mutex_;  // held while it is called
  OnLost on_lost_ ABSL_GUARDED_BY(on_lost_mutex_);

  std::thread thread_;  // last: it uses the others
};

}  // namespace plumescout::server
