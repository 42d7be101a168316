// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// Grey picture, top row first; 0 is black, 255 white.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // width * height

  friend bool operator==(const GrayImage&, const GrayImage&) = default;
};

// Reads a binary PGM (P5) with 255 grey levels; comments in the header are skipped.
//
// Errors, each naming the file: kNotFound; kDataLoss if the header does not parse or pixels are
// missing; kInvalidArgument for other grey levels or more than 2^26 pixels.
absl::StatusOr<GrayImage> ReadPgm(const std::string& path);

// The same from memory; errors name no file.
absl::StatusOr<GrayImage> ParsePgm(absl::string_view bytes);

// kInvalidArgument unless pixels fill a picture of at least one pixel; else as WriteFile.
absl::Status WritePgm(const GrayImage& image, const std::string& path);

}  // namespace plumescout
