// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_keeper.h"

#include <algorithm>
#include <utility>

#include "absl/time/clock.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

// How often a quiet log is looked at, for what the server has said of it.
constexpr absl::Duration kQuietPeriod = absl::Seconds(1);
constexpr std::int64_t kNoEntry = std::int64_t{1} << 62;  // beyond the numbers of any log

}  // namespace

LogKeeper::LogKeeper(std::unique_ptr<LogStore> store, std::int64_t next_sequence,
                     const LogKeeping& keeping, LogFeed feed,
                     std::function<void(const absl::Status&)> on_disk)
    : store_(std::move(store)),
      keeping_(keeping),
      feed_(std::move(feed)),
      on_disk_(std::move(on_disk)),
      next_sequence_(next_sequence),
      synced_sequence_(next_sequence),
      renumberings_(store_->renumberings()),
      last_sync_(absl::Now()),
      thread_([this] { Run(); }) {}

LogKeeper::~LogKeeper() { thread_.join(); }

void LogKeeper::Run() {
  while (true) {
    // A disk that fails is left alone for a while, but for what can be removed from it.
    if (!disk_.ok()) {
      const LogNews rest = feed_(kNoEntry, keeping_.retry_period);
      Follow(rest);
    }
    const LogNews news = feed_(next_sequence_, Patience());
    Follow(news);
    absl::Status status = Write(news);
    const bool last = news.ended && (news.entries.empty() || !status.ok());
    const bool due = last || absl::Now() - last_sync_ >= keeping_.sync_period;
    if (status.ok() && due) status = Sync(news.mark);
    NoteDisk(status);
    if (last) return;
  }
}

// How long there is nothing to do if nothing comes.
absl::Duration LogKeeper::Patience() const {
  if (!disk_.ok()) return absl::ZeroDuration();
  if (!dirty_) return kQuietPeriod;
  return std::clamp(last_sync_ + keeping_.sync_period - absl::Now(), absl::ZeroDuration(),
                    kQuietPeriod);
}

void LogKeeper::Follow(const LogNews& news) {
  for (const Renumbering& renumbering : news.renumberings) {
    const std::int64_t by = renumbering.to - renumbering.from;
    next_sequence_ = std::max(next_sequence_, renumbering.from) + by;
    synced_sequence_ = std::max(synced_sequence_, renumbering.from) + by;
    owed_.push_back({++renumberings_, renumbering});
  }
  store_->DropBefore(news.first_held_sequence);
}

absl::Status LogKeeper::Write(const LogNews& news) {
  for (; !owed_.empty(); owed_.erase(owed_.begin())) {
    PLUMESCOUT_RETURN_IF_ERROR(store_->Append(owed_.front()));
    unsynced_.push_back(owed_.front());
    dirty_ = true;
  }
  for (const Observation& entry : news.entries) {
    if (!std::holds_alternative<SequenceGap>(entry.payload)) {
      PLUMESCOUT_RETURN_IF_ERROR(store_->Append(entry));
      dirty_ = true;
    }
    next_sequence_ = LastSequence(entry) + 1;
  }
  return absl::OkStatus();
}

absl::Status LogKeeper::Sync(const LogMark& mark) {
  last_sync_ = absl::Now();
  if (!(mark == mark_)) {
    PLUMESCOUT_RETURN_IF_ERROR(store_->Append(mark));
    mark_ = mark;
    dirty_ = true;
  }
  if (!dirty_) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(store_->Sync());
  dirty_ = false;
  synced_sequence_ = next_sequence_;
  unsynced_.clear();
  return absl::OkStatus();
}

void LogKeeper::NoteDisk(const absl::Status& status) {
  if (store_->failed_syncs() != failed_syncs_) Rewind();
  if (status.ok() != disk_.ok() && on_disk_) on_disk_(status);
  disk_ = status;
}

// A sync has failed: all that came since the one before has to be written again.
void LogKeeper::Rewind() {
  failed_syncs_ = store_->failed_syncs();
  owed_.insert(owed_.begin(), unsynced_.begin(), unsynced_.end());
  unsynced_.clear();
  next_sequence_ = synced_sequence_;
  mark_ = {};
}

}  // namespace plumescout::client
