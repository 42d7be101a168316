// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/zstd_codec.h"

#include <zstd.h>

#include "absl/strings/str_cat.h"

namespace plumescout {

absl::StatusOr<std::string> CompressZstd(absl::string_view bytes, int level) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size) != 0) return absl::InternalError(ZSTD_getErrorName(size));
  frame.resize(size);
  return frame;
}

absl::Status DecompressZstd(absl::string_view frame, char* out, std::size_t size) {
  const unsigned long long said = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (said < ZSTD_CONTENTSIZE_ERROR && said != size) {
    return absl::DataLossError(
        absl::StrCat("the zstd frame holds ", said, " bytes, expected ", size));
  }
  const std::size_t unpacked = ZSTD_decompress(out, size, frame.data(), frame.size());
  if (ZSTD_isError(unpacked) != 0) return absl::DataLossError(ZSTD_getErrorName(unpacked));
  if (unpacked != size) {
    return absl::DataLossError(
        absl::StrCat("the zstd frame holds ", unpacked, " bytes, expected ", size));
  }
  return absl::OkStatus();
}

}  // namespace plumescout
