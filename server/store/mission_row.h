// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "server/store/checksum.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// How a mission stands in the database.
struct MissionRow {
  std::string key;
  std::int64_t id = 0;
  std::int64_t epoch = 0;
  std::int64_t head = 0;
  std::uint32_t chain = 0;       // checksum of all records up to the head, see checksum.h
  std::int64_t base = 0;         // the last record that was trimmed; 0: none was
  std::uint32_t base_chain = 0;  // checksum of all records up to that one
  std::int64_t bytes = 0;        // of header, standing, records and snapshots
  std::uint32_t standing_crc = 0;
  std::int64_t writes = 0;  // grows with every Save
};

inline std::uint32_t RowChecksum(const MissionRow& row) {
  return Checksum()
      .Add(row.key)
      .Add(row.id)
      .Add(row.epoch)
      .Add(row.head)
      .Add(std::int64_t{row.chain})
      .Add(row.base)
      .Add(std::int64_t{row.base_chain})
      .Add(row.bytes)
      .Add(std::int64_t{row.standing_crc})
      .Add(row.writes)
      .value();
}

inline std::uint32_t SnapshotChecksum(std::int64_t mission, const StoredSnapshot& snapshot) {
  return Checksum()
      .Add(mission)
      .Add(snapshot.revision)
      .Add(static_cast<std::int64_t>(snapshot.digest))
      .Add(snapshot.bytes)
      .value();
}

}  // namespace plumescout::server
