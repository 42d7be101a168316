// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// The whole file.
//
// Errors, each naming the file: kNotFound; kInvalidArgument if it is no regular file or longer than
// `max_bytes`; kDataLoss if it could not be read to its end.
absl::StatusOr<std::string> ReadFile(const std::string& path, std::uint64_t max_bytes);

// Replaces the file in one step (written beside it, then renamed), so readers never see half of it.
// Errors: kNotFound if the folder does not exist, kUnavailable if the system refuses.
absl::Status WriteFile(const std::string& path, absl::string_view bytes);

// Makes the folder and those above it, unless they stand. Errors: kUnavailable.
absl::Status MakeFolder(const std::string& path);

}  // namespace plumescout
