// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "server/store/committed_store.h"

namespace plumescout::server {

// Keeps missions as long as it lives.
class MemoryStore final : public CommittedStore {
 public:
  // `is_durable`: what it says of itself. Tests of what outlives a server keep the store.
  explicit MemoryStore(bool is_durable = false);

  absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string& key,
                                                      std::int64_t first_number) override;
  absl::StatusOr<AcquiredMission> Peek(const std::string& key) override;
  absl::StatusOr<std::vector<StoredMission>> List() override;
  bool is_durable() const override { return is_durable_; }
  // How often a journal was opened.
  int read_count() const { return read_count_; }

 private:
  class Shelf;

  MemoryStore(bool is_durable, std::shared_ptr<Shelf> shelf);

  const bool is_durable_;
  std::atomic<int> read_count_ = 0;
  const std::shared_ptr<Shelf> shelf_;  // with readers
};

}  // namespace plumescout::server
