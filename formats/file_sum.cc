// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/file_sum.h"

#include <openssl/evp.h>
#include <openssl/sha.h>
#include <zlib.h>

namespace plumescout {

FileSum::FileSum() : sha256_(EVP_MD_CTX_new()) {
  EVP_DigestInit_ex(sha256_.get(), EVP_sha256(), nullptr);
}

void FileSum::Freer::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

void FileSum::Add(absl::string_view bytes) {
  bytes_ += static_cast<std::int64_t>(bytes.size());
  crc32_ = static_cast<std::uint32_t>(
      crc32_z(crc32_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  EVP_DigestUpdate(sha256_.get(), bytes.data(), bytes.size());
}

std::string FileSum::TakeSha256() {
  std::string digest(SHA256_DIGEST_LENGTH, '\0');
  EVP_DigestFinal_ex(sha256_.get(), reinterpret_cast<unsigned char*>(digest.data()), nullptr);
  return digest;
}

}  // namespace plumescout
