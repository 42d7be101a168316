// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// Unpacks one LZ4 frame into `size` bytes at `out`, never more. kDataLoss if the frame is damaged
// or cut short, holds another number of bytes, or something follows it.
absl::Status DecompressLz4(absl::string_view frame, char* out, std::size_t size);

}  // namespace plumescout
