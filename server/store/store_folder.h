// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace plumescout::server {

// The files of a store.
std::string DatabaseFile(const std::string& folder);
std::string HeadMarksFile(const std::string& folder);
// Of all of them.
std::int64_t StoreDiskBytes(const std::string& folder);

bool FileExists(const std::string& path);
// Makes names in the folder outlive a loss of power. kUnavailable.
absl::Status SyncFolder(const std::string& folder);

// A folder that nobody else has as long as this lives. The lock is the system's: it goes with the
// process, however that ends.
class FolderLock {
 public:
  // Makes the folder, for its owner only, unless it stands.
  //
  // Errors, naming the folder or its file: kFailedPrecondition, saying who has it, if it is
  // somebody else's; kPermissionDenied and kUnavailable as the system says.
  static absl::StatusOr<FolderLock> Take(const std::string& folder);
  // Likewise, but kNotFound if there is no store.
  static absl::StatusOr<FolderLock> TakeExisting(const std::string& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : descriptor_(other.descriptor_) {
    other.descriptor_ = -1;
  }
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace plumescout::server
