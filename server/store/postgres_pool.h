// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/store/postgres_connection.h"

namespace plumescout::server {

// Connections for those who read now and then: opened when needed, kept for the next, never more
// than a few at a time. Thread-safe.
class PostgresPool {
 public:
  // A connection in use. Goes back unless it is broken.
  class Loan {
   public:
    Loan(PostgresPool* pool, std::unique_ptr<PostgresConnection> connection)
        : pool_(pool), connection_(std::move(connection)) {}
    ~Loan();
    Loan(Loan&& other) noexcept
        : pool_(std::exchange(other.pool_, nullptr)), connection_(std::move(other.connection_)) {}
    Loan& operator=(Loan&&) = delete;

    PostgresConnection& operator*() const { return *connection_; }
    PostgresConnection* operator->() const { return connection_.get(); }

   private:
    PostgresPool* pool_;
    std::unique_ptr<PostgresConnection> connection_;
  };

  // `store`: see CheckSameStore.
  PostgresPool(std::string url, std::int64_t store) : url_(std::move(url)), store_(store) {}

  // Blocks, a few seconds at most: kUnavailable if there is none by then. Errors of
  // PostgresConnection::Open and CheckSameStore.
  absl::StatusOr<Loan> Take();

 private:
  bool HasRoom() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void GiveBack(std::unique_ptr<PostgresConnection> connection);

  const std::string url_;
  const std::int64_t store_;
  absl::Mutex mutex_;
  std::vector<std::unique_ptr<PostgresConnection>> idle_ ABSL_GUARDED_BY(mutex_);
  int in_use_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace plumescout::server
