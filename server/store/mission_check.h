// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/head_marks.h"
#include "server/store/mission_rows.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// A mission as the database and the head marks agree on it.
struct CheckedMission {
  MissionRow row;
  AcquiredMission known;
};

// A mission is in the database as it was written, as far as can be told without reading its
// records: its last one is there, and so is what its mark tells of.
//
// Errors: kDataLoss, naming the files, what was found and what is known; others as of Database.
//
// A mark must be taken before the database is read, or it may tell of what was written since.
absl::Status CheckAgainstMark(MissionRows& rows, const MissionRow& row, const KnownHead& known);

// Of a mission that the database does not hold: kNotFound, or kDataLoss if it is known to be.
absl::Status WhyAbsent(const std::string& key, const std::string& file, const KnownHead& known);

// All that is kept beside the records, checked.
absl::StatusOr<CheckedMission> LoadMission(MissionRows& rows, const KnownHead& known,
                                           const std::string& key);

}  // namespace plumescout::server
