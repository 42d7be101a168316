// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/token_file.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "absl/memory/memory.h"
#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/types/status_macros.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kFieldCount = 5;
constexpr std::size_t kMaxTokenLength = 512;

absl::StatusOr<Sha256> ReadHash(const std::string& text) {
  Sha256 hash;
  const bool is_hex =
      text.size() == 2 * hash.size() && std::all_of(text.begin(), text.end(), [](char c) {
        return absl::ascii_isxdigit(static_cast<unsigned char>(c));
      });
  if (!is_hex) {
    return absl::InvalidArgumentError("the hash must be 64 hexadecimal digits");
  }
  const std::string bytes = absl::HexStringToBytes(text);
  std::copy(bytes.begin(), bytes.end(), hash.begin());
  return hash;
}

absl::StatusOr<absl::Time> ReadExpiry(const std::string& text) {
  absl::Time expiry = absl::InfiniteFuture();
  std::string error;
  if (text == "never" || absl::ParseTime(absl::RFC3339_full, text, &expiry, &error)) return expiry;
  return absl::InvalidArgumentError(
      absl::StrCat("expiry \"", absl::CHexEscape(text),
                   "\" must be a time such as 2030-01-31T00:00:00Z, or never"));
}

}  // namespace

Sha256 HashOf(absl::string_view text) {
  Sha256 hash;
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), hash.data());
  return hash;
}

absl::StatusOr<TokenEntry> ParseTokenLine(absl::string_view line) {
  const std::vector<std::string> fields =
      absl::StrSplit(line, absl::ByAnyChar(" \t"), absl::SkipEmpty());
  if (fields.size() != kFieldCount) {
    return absl::InvalidArgumentError("must be HASH NAME ROLE TENANT EXPIRY");
  }
  TokenEntry entry;
  PLUMESCOUT_ASSIGN_OR_RETURN(entry.hash, ReadHash(fields[0]));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      entry.principal, MakePrincipal(fields[1], fields[2], fields[3] == "-" ? "" : fields[3]));
  PLUMESCOUT_ASSIGN_OR_RETURN(entry.expiry, ReadExpiry(fields[4]));
  return entry;
}

absl::StatusOr<std::unique_ptr<TokenFile>> TokenFile::Open(const std::string& path) {
  auto file = absl::WrapUnique(new TokenFile(path));
  PLUMESCOUT_RETURN_IF_ERROR(file->ReadFirst());
  file->looks_ =
      std::make_unique<PeriodicTask>(kLookPeriod, [looker = file.get()] { looker->Look(); });
  return file;
}

TokenFile::Stamp TokenFile::StampOf(const std::string& path) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0) return {};
  return {static_cast<std::int64_t>(status.st_ino),
          status.st_size,
          status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec,
          status.st_ctim.tv_sec,
          status.st_ctim.tv_nsec};
}

absl::Status TokenFile::ReadFirst() {
  absl::MutexLock look(&look_);
  return Read();
}

absl::Status TokenFile::Read() {
  stamp_ = StampOf(path_);  // first: what is written meanwhile is read the next time
  auto entries = std::make_shared<Entries>();
  absl::Status status;
  std::ifstream file(path_);
  int line_number = 0;
  for (std::string text; std::getline(file, text);) {
    ++line_number;
    const absl::string_view line = absl::StripAsciiWhitespace(text);
    if (line.empty() || line.front() == '#') continue;
    auto entry = ParseTokenLine(line);
    if (entry.ok()) {
      entries->push_back(*std::move(entry));
    } else {
      status.Update(absl::InvalidArgumentError(
          absl::StrCat(path_, ":", line_number, ": ", entry.status().message())));
    }
  }
  if (!file.eof()) status = absl::NotFoundError(absl::StrCat(path_, " cannot be read"));
  absl::MutexLock lock(&mutex_);
  entries_ = std::move(entries);
  return status;
}

void TokenFile::Look() {
  absl::MutexLock look(&look_);
  if (StampOf(path_) == stamp_) return;
  const absl::Status status = Read();
  if (status.ok()) {
    LogInfo("tokens read", {{"file", path_}, {"tokens", absl::StrCat(Current()->size())}});
  } else {
    LogWarning("tokens not all read", {{"why", std::string(status.message())}});
  }
}

std::shared_ptr<const TokenFile::Entries> TokenFile::Current() const {
  absl::MutexLock lock(&mutex_);
  return entries_;
}

absl::StatusOr<Principal> TokenFile::Find(absl::string_view token, absl::Time now) const {
  const std::shared_ptr<const Entries> entries = Current();
  const Sha256 hash = HashOf(token.substr(0, kMaxTokenLength));
  const TokenEntry* found = nullptr;
  for (const TokenEntry& entry : *entries) {  // all of them: the time tells nothing
    if (CRYPTO_memcmp(entry.hash.data(), hash.data(), hash.size()) == 0) found = &entry;
  }
  if (found == nullptr || token.size() > kMaxTokenLength) {
    return absl::UnauthenticatedError("the token is not known");
  }
  if (now >= found->expiry) return absl::UnauthenticatedError("the token has expired");
  return found->principal;
}

}  // namespace plumescout::server
