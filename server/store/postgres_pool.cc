// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_pool.h"

#include "absl/status/status.h"
#include "core/types/status_macros.h"
#include "server/store/postgres_schema.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr int kMaxConnections = 8;
constexpr absl::Duration kPatience = absl::Seconds(5);

}  // namespace

PostgresPool::Loan::~Loan() {
  if (pool_ != nullptr) pool_->GiveBack(std::move(connection_));
}

bool PostgresPool::HasRoom() const { return in_use_ < kMaxConnections; }

absl::StatusOr<PostgresPool::Loan> PostgresPool::Take() {
  std::unique_ptr<PostgresConnection> connection;
  {
    absl::MutexLock lock(&mutex_);
    const bool has_room =
        mutex_.AwaitWithTimeout(absl::Condition(this, &PostgresPool::HasRoom), kPatience);
    if (!has_room) return StoreUnavailable("all connections to the database are in use");
    ++in_use_;
    if (!idle_.empty()) {
      connection = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  // One that lay idle may have been cut off since, or lead to where nothing is written any more.
  if (connection != nullptr && !CheckSameStore(*connection, store_).ok()) connection = nullptr;
  if (connection != nullptr) return Loan(this, std::move(connection));
  absl::StatusOr<std::unique_ptr<PostgresConnection>> opened =
      PostgresConnection::Open(url_, kPatience);
  absl::Status status = opened.status();
  if (status.ok()) status = CheckSameStore(**opened, store_);
  if (!status.ok()) {
    GiveBack(nullptr);
    return status;
  }
  return Loan(this, *std::move(opened));
}

void PostgresPool::GiveBack(std::unique_ptr<PostgresConnection> connection) {
  absl::MutexLock lock(&mutex_);
  --in_use_;
  if (connection != nullptr && !connection->is_broken()) idle_.push_back(std::move(connection));
}

}  // namespace plumescout::server
