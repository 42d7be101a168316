// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {

// What was found of one mission.
struct MissionReport {
  std::string key;
  std::int64_t epoch = 0;
  std::int64_t head = 0;
  std::int64_t records = 0;  // read and found whole
  std::int64_t bytes = 0;
  int snapshots = 0;
  int damaged_snapshots = 0;
  absl::Status status;  // kDataLoss: the first that is damaged

  bool is_whole() const { return status.ok() && damaged_snapshots == 0; }
};

struct StoreReport {
  std::string file;
  std::vector<std::string> faults;  // of the file as a whole
  std::vector<MissionReport> missions;

  bool is_whole() const;
};

// Hears what is being read; "mission demo", 3 of 64.
using VerifyProgress =
    std::function<void(absl::string_view what, std::int64_t done, std::int64_t of)>;

// Reads all that a store keeps: the structure of the database, every record, header, standing and
// snapshot by its checksum, and the head marks. Changes nothing. Takes seconds a gigabyte.
//
// Errors: kNotFound if there is no store; those of SqliteStore::Open, so also while a server runs.
absl::StatusOr<StoreReport> VerifyStore(
    const std::string& folder,
    const VerifyProgress& progress = [](absl::string_view, std::int64_t, std::int64_t) {});

}  // namespace plumescout::server
