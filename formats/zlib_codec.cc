// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/zlib_codec.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 18;

// The state of one inflation, freed with the scope.
class Inflater {
 public:
  // REQUIRES: fewer than 2^32 bytes, which outlive the object.
  explicit Inflater(absl::string_view bytes) {
    // zlib does not write through it.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream_.avail_in = static_cast<uInt>(bytes.size());
    ready_ = inflateInit(&stream_) == Z_OK;
  }
  ~Inflater() {
    if (ready_) inflateEnd(&stream_);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  bool ready() const { return ready_; }
  bool HasInputLeft() const { return stream_.avail_in > 0; }

  // Unpacks up to `size` bytes; zlib's return code and how many bytes came.
  std::pair<int, std::size_t> Inflate(char* out, std::size_t size) {
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(size);
    const int code = inflate(&stream_, Z_NO_FLUSH);
    return {code, size - stream_.avail_out};
  }

 private:
  z_stream stream_ = {};
  bool ready_ = false;
};

}  // namespace

absl::StatusOr<std::string> DecompressZlib(absl::string_view bytes, std::uint64_t max_bytes) {
  if (bytes.size() > std::numeric_limits<uInt>::max()) {
    return absl::InvalidArgumentError("the zlib stream is longer than 4 GiB");
  }
  Inflater inflater(bytes);
  if (!inflater.ready()) return absl::ResourceExhaustedError("no memory to unpack a zlib stream");
  std::string unpacked;
  while (true) {
    const std::size_t before = unpacked.size();
    unpacked.resize(before + kChunkBytes);
    const auto [code, count] = inflater.Inflate(unpacked.data() + before, kChunkBytes);
    unpacked.resize(before + count);
    if (unpacked.size() > max_bytes) {
      return absl::InvalidArgumentError(
          absl::StrCat("the zlib stream unpacks to more than ", max_bytes, " bytes"));
    }
    if (code == Z_STREAM_END) break;
    if (code != Z_OK || count == 0) {
      return absl::DataLossError("the zlib stream is damaged or truncated");
    }
  }
  if (inflater.HasInputLeft()) return absl::DataLossError("bytes follow the zlib stream");
  return unpacked;
}

std::string CompressZlib(absl::string_view bytes, int level) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()),
                             static_cast<uLong>(bytes.size()), level);
  packed.resize(code == Z_OK ? size : 0);  // it fails for want of memory alone
  return packed;
}

}  // namespace plumescout
