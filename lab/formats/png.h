// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "lab/formats/image.h"

namespace plumescout::lab {

// The picture as a PNG file of 8-bit RGB. kInvalidArgument if it has no pixels.
absl::StatusOr<std::string> EncodePng(const Image& image);

// Any PNG, as 8-bit RGB on black. kDataLoss if it is damaged; kInvalidArgument if it has more than
// 2^26 pixels.
absl::StatusOr<Image> DecodePng(absl::string_view bytes);

// EncodePng, then WriteFile.
absl::Status WritePng(const Image& image, const std::string& path);

}  // namespace plumescout::lab
