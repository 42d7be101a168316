// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/lz4_codec.h"

#include <lz4frame.h>

#include <memory>

#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

using Context = std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)>;

absl::Status OtherSize(absl::string_view more_or_less, std::size_t size) {
  return absl::DataLossError(
      absl::StrCat("the lz4 frame holds ", more_or_less, " than the ", size, " bytes expected"));
}

}  // namespace

absl::Status DecompressLz4(absl::string_view frame, char* out, std::size_t size) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0) {
    return absl::ResourceExhaustedError("no memory to unpack lz4");
  }
  const Context context(raw, LZ4F_freeDecompressionContext);
  std::size_t written = 0;
  std::size_t read = 0;
  // What the library wants next; 0 once the frame is over.
  std::size_t wanted = 1;
  while (wanted != 0) {
    std::size_t written_now = size - written;
    std::size_t read_now = frame.size() - read;
    wanted = LZ4F_decompress(context.get(), out + written, &written_now, frame.data() + read,
                             &read_now, nullptr);
    if (LZ4F_isError(wanted) != 0) {
      return absl::DataLossError(absl::StrCat("lz4: ", LZ4F_getErrorName(wanted)));
    }
    written += written_now;
    read += read_now;
    if (wanted == 0 || read_now + written_now > 0) continue;
    return written == size && read < frame.size()
               ? OtherSize("more", size)
               : absl::DataLossError("the lz4 frame is cut short");
  }
  if (written != size) return OtherSize("less", size);
  if (read != frame.size()) return absl::DataLossError("something follows the lz4 frame");
  return absl::OkStatus();
}

}  // namespace plumescout
