// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "absl/strings/string_view.h"

struct evp_md_ctx_st;  // of OpenSSL

namespace plumescout {

// What vouches for the bytes of a file as they pass by: their number, CRC-32 (zlib's) and SHA-256.
// Single-threaded.
class FileSum {
 public:
  FileSum();

  void Add(absl::string_view bytes);

  std::int64_t bytes() const { return bytes_; }
  std::uint32_t crc32() const { return crc32_; }
  // 32 bytes. Nothing is added any more.
  std::string TakeSha256();

 private:
  struct Freer {
    void operator()(evp_md_ctx_st* context) const;
  };

  std::int64_t bytes_ = 0;
  std::uint32_t crc32_ = 0;
  const std::unique_ptr<evp_md_ctx_st, Freer> sha256_;
};

}  // namespace plumescout
