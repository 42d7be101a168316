// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What is packed: zlib, zstd and lz4 as they come, and known maps whose cells are packed well.

#include <algorithm>
#include <cstdint>
#include <string>

#include "formats/lz4_codec.h"
#include "formats/zlib_codec.h"
#include "formats/zstd_codec.h"
#include "proto/convert/prior_map.h"

namespace {

constexpr std::size_t kRoom_bytes = 4096;

// The first two bytes are the sides of the map.
void ReadMap(absl::string_view bytes) {
  if (bytes.size() < 2) return;
  plumescout::v1::KnownCells cells;
  cells.mutable_geometry()->mutable_origin();
  cells.mutable_geometry()->set_resolution_m(0.5);
  cells.mutable_geometry()->set_column_count(static_cast<std::uint8_t>(bytes[0]));
  cells.mutable_geometry()->set_row_count(static_cast<std::uint8_t>(bytes[1]));
  cells.set_deflated_data(plumescout::CompressZlib(bytes.substr(2), 1));
  plumescout::FromProto(cells, "cells").status().IgnoreError();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto inflated = plumescout::DecompressZlib(bytes, kRoom_bytes);
  if (inflated.ok() && inflated->size() > kRoom_bytes) __builtin_trap();
  std::string room(kRoom_bytes, '\0');
  plumescout::DecompressZstd(bytes, room.data(), room.size()).IgnoreError();
  plumescout::DecompressLz4(bytes, room.data(), room.size()).IgnoreError();
  ReadMap(bytes);
  return 0;
}
