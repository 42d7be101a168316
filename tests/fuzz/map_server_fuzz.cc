// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Maps of map_server: YAML up to the first zero byte, then the image.

#include <cstdint>

#include "formats/map_server.h"
#include "formats/pgm.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = bytes.find('\0');
  const absl::string_view yaml = bytes.substr(0, end);
  const absl::string_view pgm = end == absl::string_view::npos ? "" : bytes.substr(end + 1);
  plumescout::ParseMapServer(yaml, pgm).status().IgnoreError();
  plumescout::ParsePgm(bytes).status().IgnoreError();
  return 0;
}
