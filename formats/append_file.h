// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// A new file that grows piece by piece. What was appended outlives the process at once, but a loss
// of power only once the system has written it.
class AppendFile {
 public:
  // Errors, naming the file: kAlreadyExists; kUnavailable as the system says.
  static absl::StatusOr<AppendFile> Create(const std::string& path);
  ~AppendFile();
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&&) = delete;

  // All of the piece, or none of it: kUnavailable, naming file and reason, such as a full disk.
  absl::Status Append(absl::string_view bytes);
  std::int64_t size_bytes() const { return size_bytes_; }

 private:
  AppendFile(std::string path, int descriptor);

  std::string path_;
  int descriptor_;
  std::int64_t size_bytes_ = 0;
};

}  // namespace plumescout
