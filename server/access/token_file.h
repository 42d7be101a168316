// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/access/principal.h"

namespace plumescout::server {

using Sha256 = std::array<unsigned char, 32>;

Sha256 HashOf(absl::string_view text);

// A bearer token as its file knows it: by its hash.
struct TokenEntry {
  Sha256 hash;
  Principal principal;
  absl::Time expiry = absl::InfiniteFuture();
};

// Reads "HASH NAME ROLE TENANT EXPIRY": SHA-256 in hexadecimal digits, a tenant or "-", a time of
// RFC 3339 or "never". kInvalidArgument saying what is wrong.
absl::StatusOr<TokenEntry> ParseTokenLine(absl::string_view line);

// The tokens of a file: one a line, beside empty lines and comments ("# ..."). Looks at the file at
// every question, so what is revoked is so at once. Thread-safe.
class TokenFile {
 public:
  // A file that cannot be read, or has a line that cannot, is refused.
  static absl::StatusOr<std::unique_ptr<TokenFile>> Open(const std::string& path);

  // Whose token it is; kUnauthenticated. A file that went away has no tokens, and a line that was
  // spoiled since has none: the others still hold.
  absl::StatusOr<Principal> Find(absl::string_view token, absl::Time now)
      ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  // What tells one state of a file from another.
  using Stamp = std::array<std::int64_t, 6>;
  using Entries = std::vector<TokenEntry>;

  explicit TokenFile(const std::string& path) : path_(path) {}

  static Stamp StampOf(const std::string& path);
  // The first thing that is wrong with the file.
  absl::Status Read() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status ReadFirst() ABSL_LOCKS_EXCLUDED(mutex_);
  std::shared_ptr<const Entries> Current() ABSL_LOCKS_EXCLUDED(mutex_);

  const std::string path_;

  absl::Mutex mutex_;
  Stamp stamp_ ABSL_GUARDED_BY(mutex_) = {};
  std::shared_ptr<const Entries> entries_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
