// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/committer.h"
#include "server/store/mission_store.h"
#include "server/store/store_write.h"

namespace plumescout::server {

// What writes to a store, given an engine to commit to. An engine's own store adds the reading.
class CommittedStore : public MissionStore {
 public:
  absl::StatusOr<std::int64_t> Create(const std::string& key, const std::string& header) override;
  absl::StatusOr<AcquiredMission> Acquire(const std::string& key) override;
  void Append(const std::string& key, std::int64_t epoch, std::int64_t first_number,
              std::vector<std::string> records, Done done) override;
  void PutStanding(const std::string& key, std::int64_t epoch, std::string standing,
                   Done done) override;
  void PutSnapshot(const std::string& key, std::int64_t epoch, StoredSnapshot snapshot,
                   Done done) override;
  void Trim(const std::string& key, std::int64_t epoch, Done done) override;
  void Remove(const std::string& key, std::int64_t epoch, Done done) override;
  void Discard(const std::string& key, Done done) override;
  StoreState state() const override;

 protected:
  CommittedStore(const CommitterOptions& options, std::unique_ptr<WriteEngine> engine);

  Committer& committer() { return committer_; }

 private:
  const std::unique_ptr<WriteEngine> engine_;
  Committer committer_;  // goes before the engine
};

}  // namespace plumescout::server
