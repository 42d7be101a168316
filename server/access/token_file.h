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
#include "server/base/periodic_task.h"

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

// The tokens of a file: one a line, beside empty lines and comments ("# ..."). A thread of its own
// looks at the file, so whoever asks waits for no disk, and what is revoked is so soon.
// Thread-safe.
class TokenFile {
 public:
  static constexpr absl::Duration kLookPeriod = absl::Milliseconds(100);

  // A file that cannot be read, or has a line that cannot, is refused.
  static absl::StatusOr<std::unique_ptr<TokenFile>> Open(const std::string& path);

  // Whose token it is; kUnauthenticated. A file that went away has no tokens, and a line that was
  // spoiled since has none: the others still hold.
  absl::StatusOr<Principal> Find(absl::string_view token, absl::Time now) const
      ABSL_LOCKS_EXCLUDED(mutex_);

  // Reads the file if it has changed; not for those who may not wait.
  void Look() ABSL_LOCKS_EXCLUDED(look_, mutex_);

 private:
  // What tells one state of a file from another.
  using Stamp = std::array<std::int64_t, 6>;
  using Entries = std::vector<TokenEntry>;

  explicit TokenFile(const std::string& path) : path_(path) {}

  static Stamp StampOf(const std::string& path);
  // The first thing that is wrong with the file.
  absl::Status Read() ABSL_EXCLUSIVE_LOCKS_REQUIRED(look_) ABSL_LOCKS_EXCLUDED(mutex_);
  absl::Status ReadFirst() ABSL_LOCKS_EXCLUDED(look_, mutex_);
  std::shared_ptr<const Entries> Current() const ABSL_LOCKS_EXCLUDED(mutex_);

  const std::string path_;

  absl::Mutex look_;  // held for as long as the disk takes
  Stamp stamp_ ABSL_GUARDED_BY(look_) = {};
  mutable absl::Mutex mutex_;
  std::shared_ptr<const Entries> entries_ ABSL_GUARDED_BY(mutex_);
  std::unique_ptr<PeriodicTask> looks_;  // last: it uses all of the above
};

}  // namespace plumescout::server
