// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "formats/journal/journal_file.h"
#include "server/history/mission_export.h"

namespace plumescout::server {

// What an export sends.
struct ExportedFile {
  absl::Status status;
  v1::MissionFileStart start;
  std::vector<v1::MissionFilePiece> pieces;
  v1::MissionFileEnd end;
  std::string bytes;
};

inline ExportedFile ExportFile(MissionStore& store, const std::string& key,
                               const ExportPoint& point,
                               const MissionExport::MakePast& make_past = {}) {
  ExportedFile file;
  auto exported = MissionExport::Begin(store, key, point, make_past);
  file.status = exported.status();
  while (file.status.ok()) {
    const auto next = (*exported)->Next();
    file.status = next.status();
    if (!next.ok() || !next->has_value()) break;
    if ((*next)->has_start()) file.start = (*next)->start();
    if ((*next)->has_piece()) file.pieces.push_back((*next)->piece());
    if ((*next)->has_end()) file.end = (*next)->end();
  }
  for (const v1::MissionFilePiece& piece : file.pieces) file.bytes += piece.data();
  return file;
}

inline absl::StatusOr<JournalFileReader> OpenAsFile(const std::string& bytes,
                                                    const std::string& path) {
  std::ofstream(path, std::ios::binary) << bytes;
  return JournalFileReader::Open(path);
}

}  // namespace plumescout::server
