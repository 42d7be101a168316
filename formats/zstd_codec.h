// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// The library's own.
inline constexpr int kZstdLevel = 3;

// One zstd frame that holds `bytes`. kInternal if the library fails.
absl::StatusOr<std::string> CompressZstd(absl::string_view bytes, int level = kZstdLevel);

// Unpacks one zstd frame into `size` bytes at `out`, never more. kDataLoss if the frame is damaged
// or holds another number of bytes.
absl::Status DecompressZstd(absl::string_view frame, char* out, std::size_t size);

}  // namespace plumescout
