// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/lab/bags/bag_files.h"

#include <sqlite3.h>

namespace plumescout::lab {

void WriteSqliteBag(const std::string& path, const std::vector<BagMessage>& messages,
                    const Encodings& encodings) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const char* const kTables =
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
      " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
      " timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
      "CREATE INDEX timestamp_idx ON messages (timestamp ASC); BEGIN";
  ASSERT_EQ(sqlite3_exec(database, kTables, nullptr, nullptr, nullptr), SQLITE_OK);
  std::map<std::string, int> topics;
  const auto run = [database](const char* sql, const std::vector<std::string>& texts,
                              const std::vector<std::int64_t>& numbers) {
    sqlite3_stmt* statement = nullptr;
    ASSERT_EQ(sqlite3_prepare_v2(database, sql, -1, &statement, nullptr), SQLITE_OK);
    int at = 0;
    for (const std::int64_t number : numbers) sqlite3_bind_int64(statement, ++at, number);
    for (const std::string& text : texts) {
      sqlite3_bind_blob(statement, ++at, text.data(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT);
    }
    ASSERT_EQ(sqlite3_step(statement), SQLITE_DONE) << sqlite3_errmsg(database);
    sqlite3_finalize(statement);
  };
  for (const BagMessage& message : messages) {
    int& topic = topics[message.topic];
    if (topic == 0) {
      topic = static_cast<int>(topics.size());
      const auto other = encodings.find(message.topic);
      run("INSERT INTO topics VALUES(?1, CAST(?2 AS TEXT), CAST(?3 AS TEXT), CAST(?4 AS TEXT), '')",
          {message.topic, message.type, other == encodings.end() ? "cdr" : other->second}, {topic});
    }
    run("INSERT INTO messages(topic_id, timestamp, data) VALUES(?1, ?2, ?3)", {message.cdr},
        {topic, message.log_time_ns});
  }
  ASSERT_EQ(sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
}

}  // namespace plumescout::lab
