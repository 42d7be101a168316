// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// Unpacks one zlib stream (RFC 1950). kDataLoss if it is damaged, truncated or followed by other
// bytes; kInvalidArgument if it unpacks to more than `max_bytes`.
absl::StatusOr<std::string> DecompressZlib(absl::string_view bytes, std::uint64_t max_bytes);

// Packs. `level`: 1 is the fastest, 9 the smallest; -1 is zlib's own choice.
std::string CompressZlib(absl::string_view bytes, int level = -1);

}  // namespace plumescout
