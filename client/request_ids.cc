// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/request_ids.h"

#include <algorithm>
#include <functional>

#include "absl/strings/str_cat.h"

namespace plumescout::client {
namespace {

constexpr std::size_t kMaxOpen = 64;

// The call may have been carried out, and only its answer lost.
bool IsUncertain(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kUnavailable:
    case absl::StatusCode::kDeadlineExceeded:
    case absl::StatusCode::kCancelled:
    case absl::StatusCode::kInternal:
    case absl::StatusCode::kUnknown:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string RequestIds::NameOf(const std::string& content) {
  const std::size_t hash = std::hash<std::string>()(content);
  absl::MutexLock lock(&mutex_);
  const auto found = std::find_if(open_.begin(), open_.end(),
                                  [&](const Open& open) { return open.content_hash == hash; });
  if (found != open_.end()) return found->name;
  return absl::StrCat(absl::Hex(bits_(), absl::kZeroPad16), absl::Hex(bits_(), absl::kZeroPad16));
}

void RequestIds::NoteEnd(const std::string& content, const std::string& name,
                         const absl::Status& status) {
  absl::MutexLock lock(&mutex_);
  const auto end = std::remove_if(open_.begin(), open_.end(),
                                  [&](const Open& open) { return open.name == name; });
  open_.erase(end, open_.end());
  if (!IsUncertain(status)) return;
  if (open_.size() >= kMaxOpen) open_.pop_front();
  open_.push_back({std::hash<std::string>()(content), name});
}

}  // namespace plumescout::client
