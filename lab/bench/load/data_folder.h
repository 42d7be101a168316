// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace plumescout::lab {

// A folder for the missions of a server, below that for temporary files; gone with the object.
class DataFolder {
 public:
  DataFolder();
  ~DataFolder();
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;

  // Of a server that keeps its missions here.
  std::vector<std::string> Settings() const;
  // How long a write of a page takes here until it is on the disk: the median of some.
  absl::StatusOr<absl::Duration> SyncTime() const;

 private:
  std::string path_;
};

}  // namespace plumescout::lab
