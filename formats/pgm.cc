// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/pgm.h"

#include <algorithm>
#include <cstddef>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"

namespace plumescout {
namespace {

constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 26;
constexpr std::uint64_t kMaxHeaderBytes = 65536;  // comments included
constexpr int kMaxGray = 255;

// Reads the next number of the header, past blanks and comments, and leaves `at` behind it.
absl::StatusOr<int> NextNumber(absl::string_view bytes, std::size_t& at) {
  while (at < bytes.size() && (bytes[at] == '#' || absl::ascii_isspace(bytes[at]))) {
    at = bytes[at] == '#' ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
  }
  const std::size_t begin = at;
  while (at < bytes.size() && absl::ascii_isdigit(bytes[at])) ++at;
  int number = 0;
  if (!absl::SimpleAtoi(bytes.substr(begin, at - begin), &number)) {
    return absl::DataLossError(absl::StrCat("no number in the PGM header at byte ", begin));
  }
  return number;
}

}  // namespace

absl::StatusOr<GrayImage> ParsePgm(absl::string_view bytes) {
  if (!absl::StartsWith(bytes, "P5")) return absl::DataLossError("no binary PGM (P5)");
  std::size_t at = 2;
  GrayImage image;
  PLUMESCOUT_ASSIGN_OR_RETURN(image.width, NextNumber(bytes, at));
  PLUMESCOUT_ASSIGN_OR_RETURN(image.height, NextNumber(bytes, at));
  PLUMESCOUT_ASSIGN_OR_RETURN(const int max_gray, NextNumber(bytes, at));
  if (max_gray != kMaxGray) {
    return absl::InvalidArgumentError(absl::StrCat("greatest grey is ", max_gray, ", not 255"));
  }
  const std::uint64_t count =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  if (count == 0 || count > kMaxPixels) {
    return absl::InvalidArgumentError(
        absl::StrCat(image.width, " x ", image.height, " pixels, from 1 to 2^26 are read"));
  }
  ++at;  // the one blank between header and pixels
  at = std::min(at, bytes.size());
  if (bytes.size() - at < count) {
    return absl::DataLossError(
        absl::StrCat("pixels are missing: ", bytes.size() - at, " of ", count));
  }
  const absl::string_view pixels = bytes.substr(at, count);
  image.pixels.assign(pixels.begin(), pixels.end());
  return image;
}

absl::StatusOr<GrayImage> ReadPgm(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string bytes,
                              ReadFile(path, kMaxPixels + kMaxHeaderBytes));
  absl::StatusOr<GrayImage> image = ParsePgm(bytes);
  if (image.ok()) return image;
  return absl::Status(image.status().code(), absl::StrCat(path, ": ", image.status().message()));
}

absl::Status WritePgm(const GrayImage& image, const std::string& path) {
  const bool filled = image.width > 0 && image.height > 0 &&
                      image.pixels.size() == static_cast<std::uint64_t>(image.width) *
                                                 static_cast<std::uint64_t>(image.height);
  if (!filled) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": ", image.pixels.size(),
                                                   " pixels do not fill a picture of ", image.width,
                                                   " x ", image.height));
  }
  std::string bytes = absl::StrCat("P5\n", image.width, " ", image.height, "\n", kMaxGray, "\n");
  bytes.append(image.pixels.begin(), image.pixels.end());
  return WriteFile(path, bytes);
}

}  // namespace plumescout
