// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/postgres_connection.h"
#include "server/store/postgres_missions.h"
#include "server/store/store_write.h"

namespace plumescout::server {

struct PostgresEngineOptions {
  std::string url;
  std::int64_t store = 0;  // see CheckSameStore
  // The lease under which this node acquires; 0: it has none.
  std::function<std::int64_t()> lease;
};

// Writes to a database in PostgreSQL that other servers write to, too. A batch is one round trip
// and one transaction, which locks rows in one order: leases by their numbers, then missions by
// their keys. So servers whose batches meet wait for each other, and never in a circle. It is made
// of what this engine remembers of its missions; each statement does nothing if its mission is not
// so any more, and then it is made again of what the database says.
class PostgresEngine final : public WriteEngine {
 public:
  explicit PostgresEngine(PostgresEngineOptions options) : options_(std::move(options)) {}

  // A batch without writes is a chore, or else changes a row of its own.
  absl::Status Commit(std::span<StoreWrite> writes) override;
  bool has_chores() const override { return has_chores_; }

 private:
  struct Planned {
    StoreWrite* write = nullptr;
    std::size_t statement = 0;
  };
  // What is sent at once.
  struct Round {
    std::set<std::int64_t> forgotten;  // leases that are forgotten, in this order, before all else
    std::vector<PostgresStatement> statements;
    std::vector<Planned> planned;
    std::vector<StoreWrite*> put_off;  // to the next round, in order
    std::set<std::string> put_off_keys;
    std::map<std::string, std::optional<SharedRow>> rows;  // as they are to be; none: gone
  };

  absl::Status Connect();
  absl::Status CommitConnected(std::span<StoreWrite> writes);
  absl::Status CommitRound(std::vector<StoreWrite*>& writes, bool is_first);
  absl::Status Send(Round& round);
  // Rows that are not remembered, or must not be believed.
  absl::Status LoadRows(const std::vector<StoreWrite*>& writes, bool is_first);

  // An error is that of the connection, or of this write alone; what it asks in vain is its
  // `result`.
  absl::Status Plan(Round& round, StoreWrite& write);
  absl::Status PlanFor(Round& round, StoreWrite& write, const SharedRow& shared);
  absl::Status PlanCreate(Round& round, StoreWrite& write, const SharedRow* shared);
  absl::Status PlanUndo(Round& round, StoreWrite& write, const SharedRow& shared);
  absl::Status PlanAcquire(Round& round, StoreWrite& write);
  absl::Status PlanDiscard(Round& round, StoreWrite& write);
  absl::Status NoLease() const;
  absl::Status PlanAppend(Round& round, StoreWrite& write, const SharedRow& shared);
  absl::Status PlanSnapshot(Round& round, StoreWrite& write, const SharedRow& shared);
  absl::Status PlanTrim(Round& round, StoreWrite& write, const SharedRow& shared);
  // Epochs tell owners of one mission apart, not missions that had the same key one after another.
  bool IsOwn(const MissionRow& row) const;

  void Add(Round& round, StoreWrite& write, PostgresStatement statement,
           std::optional<SharedRow> after);
  // The answer, unless it was found by what is remembered: then the database is asked.
  void Refuse(Round& round, StoreWrite& write, absl::Status why);
  // Until the next round.
  static void PutOff(Round& round, StoreWrite& write);
  absl::Status DoChore();

  const PostgresEngineOptions options_;
  std::unique_ptr<PostgresConnection> connection_;          // null after an error
  std::map<std::string, SharedRow> known_;                  // of missions that are written
  std::map<std::string, absl::StatusOr<SharedRow>> fresh_;  // of this round, as just read
  // Of missions by key: what this engine made or took over last.
  struct Own {
    std::int64_t epoch = 0;
    std::int64_t id = 0;
  };
  std::map<std::string, Own> own_;
  bool has_chores_ = true;  // until none is found
};

}  // namespace plumescout::server
