// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/bag_reader.h"

#include <filesystem>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "formats/mcap/mcap_reader.h"
#include "lab/bags/mcap_bag.h"
#include "lab/bags/sqlite_bag.h"

namespace plumescout::lab {

absl::StatusOr<std::unique_ptr<BagReader>> OpenBag(const std::string& path,
                                                   const std::set<std::string>& wanted_topics) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return absl::NotFoundError(absl::StrCat(path, ": no such file"));
  }
  if (McapReader::IsMcap(path)) return OpenMcapBag(path, wanted_topics);
  if (IsSqlite(path)) return OpenSqliteBag(path, wanted_topics);
  return absl::InvalidArgumentError(
      absl::StrCat(path, ": neither an MCAP file nor one of SQLite; of a folder name the file"));
}

}  // namespace plumescout::lab
