// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace plumescout::client {

// A folder that one process has for itself, until the object or the process ends: the kernel gives
// it up for a process that was killed.
class FolderLock {
 public:
  // kFailedPrecondition if another has it (naming the folder and the process), kUnavailable if the
  // system refuses.
  static absl::StatusOr<FolderLock> Take(const std::string& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;  // -1: moved from
};

}  // namespace plumescout::client
