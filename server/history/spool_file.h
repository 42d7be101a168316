// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {

// A file without a name, which goes with the process however that ends. Single-threaded.
class SpoolFile {
 public:
  // In the folder; empty: in the system's for temporary files. kUnavailable, naming the folder.
  static absl::StatusOr<SpoolFile> Create(const std::string& folder);
  ~SpoolFile();
  SpoolFile(SpoolFile&& other) noexcept;
  SpoolFile& operator=(SpoolFile&&) = delete;

  // kUnavailable: the disk is full.
  absl::Status Append(absl::string_view bytes);
  // Whoever of this process opens it reads from the beginning.
  std::string path() const;

 private:
  explicit SpoolFile(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace plumescout::server
