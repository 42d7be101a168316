// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "lab/report/image.h"

namespace plumescout::lab {

// The picture as a PNG file of 8-bit RGB. kInvalidArgument if it has no pixels.
absl::StatusOr<std::string> EncodePng(const Image& image);

// EncodePng, then WriteFile.
absl::Status WritePng(const Image& image, const std::string& path);

}  // namespace plumescout::lab
