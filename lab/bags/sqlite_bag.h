// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>

#include "absl/status/statusor.h"
#include "lab/bags/bag_reader.h"

namespace plumescout::lab {

// Whether the file begins as one of SQLite does.
bool IsSqlite(const std::string& path);

// As OpenBag, of a .db3 file of rosbag2, which is not changed: messages in the order in which they
// were written. kDataLoss, saying what to do, for one that was cut off within a page.
absl::StatusOr<std::unique_ptr<BagReader>> OpenSqliteBag(
    const std::string& path, const std::set<std::string>& wanted_topics);

}  // namespace plumescout::lab
