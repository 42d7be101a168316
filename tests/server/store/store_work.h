// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "server/store/mission_store.h"
#include "server/store/sqlite_store.h"

namespace plumescout::server {

// A promise to be told of something once, and waiting for it.
class Told {
 public:
  MissionStore::Done done() {
    return [this](const absl::Status& status) {
      status_ = status;
      told_.Notify();
    };
  }
  const absl::Status& Wait() {
    told_.WaitForNotification();
    return status_;
  }
  bool is_told() const { return told_.HasBeenNotified(); }

 private:
  absl::Status status_;
  absl::Notification told_;
};

inline absl::Status AppendNow(MissionStore& store, const std::string& key, std::int64_t epoch,
                              std::int64_t first_number, std::vector<std::string> records) {
  Told answer;
  store.Append(key, epoch, first_number, std::move(records), answer.done());
  return answer.Wait();
}

inline absl::Status DiscardNow(MissionStore& store, const std::string& key) {
  Told answer;
  store.Discard(key, answer.done());
  return answer.Wait();
}

inline absl::Status PutStandingNow(MissionStore& store, const std::string& key, std::int64_t epoch,
                                   const std::string& standing) {
  Told answer;
  store.PutStanding(key, epoch, standing, answer.done());
  return answer.Wait();
}

inline absl::Status PutSnapshotNow(MissionStore& store, const std::string& key, std::int64_t epoch,
                                   StoredSnapshot snapshot) {
  Told answer;
  store.PutSnapshot(key, epoch, std::move(snapshot), answer.done());
  return answer.Wait();
}

inline absl::Status TrimNow(MissionStore& store, const std::string& key, std::int64_t epoch) {
  Told answer;
  store.Trim(key, epoch, answer.done());
  return answer.Wait();
}

inline absl::Status RemoveNow(MissionStore& store, const std::string& key, std::int64_t epoch) {
  Told answer;
  store.Remove(key, epoch, answer.done());
  return answer.Wait();
}

inline absl::StatusOr<std::vector<JournalRecord>> ReadAll(MissionStore& store,
                                                          const std::string& key,
                                                          std::int64_t first_number = 1) {
  const auto reader = store.Read(key, first_number);
  if (!reader.ok()) return reader.status();
  std::vector<JournalRecord> records;
  while (true) {
    absl::StatusOr<std::optional<JournalRecord>> record = (*reader)->Next();
    if (!record.ok()) return record.status();
    if (!record->has_value()) return records;
    records.push_back(**std::move(record));
  }
}

// Bytes that look like no others.
inline std::string RecordBytes(const std::string& key, std::int64_t number, std::size_t size = 40) {
  std::string bytes = absl::StrCat(key, " ", number, " ");
  while (bytes.size() < size) bytes += static_cast<char>(bytes.size() * 37 + bytes.back());
  return bytes;
}

inline std::vector<std::string> Records(const std::string& key, std::int64_t first_number,
                                        int count, std::size_t size = 40) {
  std::vector<std::string> records;
  for (int i = 0; i < count; ++i) records.push_back(RecordBytes(key, first_number + i, size));
  return records;
}

// What ReadAll gives of them.
inline std::vector<JournalRecord> Numbered(const std::string& key, std::int64_t first_number,
                                           int count, std::size_t size = 40) {
  std::vector<JournalRecord> records;
  for (int i = 0; i < count; ++i) {
    records.push_back({first_number + i, RecordBytes(key, first_number + i, size)});
  }
  return records;
}

inline StoreOptions InFolder(const std::string& folder) {
  StoreOptions options;
  options.folder = folder;
  options.retry_period = absl::Milliseconds(1);
  return options;
}

// The files as they are now: what a server that is killed leaves behind.
inline void CopyStore(const std::string& from, const std::string& to) {
  std::filesystem::create_directories(to);
  for (const char* name : {"store.db", "store.db-wal", "heads"}) {
    std::filesystem::remove(absl::StrCat(to, "/", name));
    if (!std::filesystem::exists(absl::StrCat(from, "/", name))) continue;
    std::filesystem::copy_file(absl::StrCat(from, "/", name), absl::StrCat(to, "/", name));
  }
  std::filesystem::remove(absl::StrCat(to, "/store.db-shm"));
}

}  // namespace plumescout::server
