// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/sqlite_bag.h"

#include <sqlite3.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr absl::string_view kSqliteMagic("SQLite format 3\0", 16);
// In the order of writing, which needs no index: of a file that was cut off the front is read.
constexpr char kMessages[] =
    "SELECT id, topic_id, timestamp, data FROM messages WHERE id > ?1 ORDER BY id";

struct Closer {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Closer>;
using Statement = std::unique_ptr<sqlite3_stmt, Closer>;

std::string TextAt(sqlite3_stmt* row, int column) {
  const void* const bytes = sqlite3_column_blob(row, column);
  const int size = sqlite3_column_bytes(row, column);
  if (bytes == nullptr) return "";
  return {static_cast<const char*>(bytes), static_cast<std::size_t>(size)};
}

class SqliteBag final : public BagReader {
 public:
  SqliteBag(std::string path, Database database, const std::set<std::string>& wanted)
      : path_(std::move(path)), database_(std::move(database)), wanted_(wanted) {}

  absl::Status Begin() {
    // What was cut off is refused at once without this.
    sqlite3_exec(database_.get(), "PRAGMA writable_schema = ON", nullptr, nullptr, nullptr);
    PLUMESCOUT_ASSIGN_OR_RETURN(const Statement topics,
                                Prepare("SELECT id, name, type, serialization_format FROM topics"));
    while (sqlite3_step(topics.get()) == SQLITE_ROW) {
      const Topic topic{TextAt(topics.get(), 1), TextAt(topics.get(), 2), TextAt(topics.get(), 3)};
      topics_[topic.name] = topic.type;
      by_id_[sqlite3_column_int64(topics.get(), 0)] = topic;
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(messages_, Prepare(kMessages));
    sqlite3_bind_int64(messages_.get(), 1, 0);
    if (Statement last = TryPrepare("SELECT max(id) FROM messages");
        last != nullptr && sqlite3_step(last.get()) == SQLITE_ROW) {
      last_id_ = sqlite3_column_int64(last.get(), 0);
    }
    return absl::OkStatus();
  }

  absl::StatusOr<std::optional<BagMessage>> Next() override {
    while (!ended_) {
      const int code = sqlite3_step(messages_.get());
      if (code != SQLITE_ROW) {
        ended_ = true;
        if (code != SQLITE_DONE) {
          torn_end_ = absl::StrCat(path_, ": cut off or damaged after message ", id_, ": ",
                                   sqlite3_errmsg(database_.get()));
        }
        break;
      }
      id_ = sqlite3_column_int64(messages_.get(), 0);
      const auto topic = by_id_.find(sqlite3_column_int64(messages_.get(), 1));
      if (topic == by_id_.end() || wanted_.count(topic->second.name) == 0) continue;
      if (topic->second.encoding != "cdr") {
        ++unknown_encodings_[topic->second.encoding];
        continue;
      }
      return BagMessage{topic->second.name, topic->second.type,
                        sqlite3_column_int64(messages_.get(), 2), TextAt(messages_.get(), 3)};
    }
    return std::optional<BagMessage>();
  }
  const std::string& torn_end() const override { return torn_end_; }
  double share_read() const override {
    if (ended_ || last_id_ <= 0) return ended_ ? 1.0 : 0.0;
    return std::min(static_cast<double>(id_) / static_cast<double>(last_id_), 1.0);
  }

 private:
  struct Topic {
    std::string name;
    std::string type;
    std::string encoding;
  };

  Statement TryPrepare(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr);
    return Statement(statement);
  }
  absl::StatusOr<Statement> Prepare(const char* sql) const {
    Statement statement = TryPrepare(sql);
    if (statement != nullptr) return statement;
    return absl::DataLossError(
        absl::StrCat(path_, ": no bag of rosbag2: ", sqlite3_errmsg(database_.get())));
  }

  const std::string path_;
  const Database database_;
  const std::set<std::string> wanted_;
  std::map<std::int64_t, Topic> by_id_;
  Statement messages_;
  std::int64_t id_ = 0;
  std::int64_t last_id_ = 0;
  bool ended_ = false;
  std::string torn_end_;
};

// SQLite reads what is missing of a page as zeros, which may pass for a message.
absl::Status CheckWholePages(const std::string& path) {
  constexpr std::size_t kHead_bytes = 18;
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead_bytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  file.seekg(0, std::ios::end);
  const auto size_bytes = static_cast<std::int64_t>(file.tellg());
  const int stated =
      static_cast<unsigned char>(head[16]) << 8 | static_cast<unsigned char>(head[17]);
  const std::int64_t page_bytes = stated == 1 ? 65536 : stated;
  if (page_bytes < 512) return absl::DataLossError(absl::StrCat(path, ": no size of its pages"));
  const std::int64_t over_bytes = size_bytes % page_bytes;
  if (over_bytes == 0) return absl::OkStatus();
  return absl::DataLossError(
      absl::StrCat(path, ": cut off within a page; of a copy that is cut to ",
                   size_bytes - over_bytes, " bytes (truncate -s) the front is read"));
}

}  // namespace

bool IsSqlite(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(kSqliteMagic.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return file.good() && begin == kSqliteMagic;
}

absl::StatusOr<std::unique_ptr<BagReader>> OpenSqliteBag(
    const std::string& path, const std::set<std::string>& wanted_topics) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckWholePages(path));
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  Database database(opened);
  if (code != SQLITE_OK) {
    return absl::DataLossError(absl::StrCat(path, ": ", sqlite3_errstr(code)));
  }
  auto bag = std::make_unique<SqliteBag>(path, std::move(database), wanted_topics);
  PLUMESCOUT_RETURN_IF_ERROR(bag->Begin());
  return bag;
}

}  // namespace plumescout::lab
