// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/mission_check.h"

#include <cstdint>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

// "record 7, epoch 2, write 31", of a row or a mark.
template <typename Known>
std::string Extent(const Known& known) {
  return absl::StrCat("record ", known.head, ", epoch ", known.epoch, ", write ", known.writes);
}

}  // namespace

absl::Status CheckAgainstMark(MissionRows& rows, const MissionRow& row, const KnownHead& known) {
  const std::string name = absl::StrCat("mission ", absl::CHexEscape(row.key));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::uint32_t last, rows.ChainAt(row, row.head));
  if (last != row.chain) {
    return StoreDamaged(
        absl::StrCat(rows.file(), ": record ", row.head, " of ", name, " is not what was written"));
  }
  const std::optional<HeadMark>& mark = known.mark;
  if (!mark.has_value()) return absl::OkStatus();
  if (mark->head > row.head || mark->epoch > row.epoch || mark->writes > row.writes) {
    return StoreDamaged(absl::StrCat(rows.file(), " ends at ", Extent(row), " of ", name, ", but ",
                                     known.file, " knows of ", Extent(*mark)));
  }
  if (mark->head < row.base) return absl::OkStatus();  // it went by since
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::uint32_t chain, rows.ChainAt(row, mark->head));
  if (chain == mark->chain) return absl::OkStatus();
  return StoreDamaged(absl::StrCat(rows.file(), ": record ", mark->head, " of ", name,
                                   " is another than the one that ", known.file, " knows of"));
}

absl::Status WhyAbsent(const std::string& key, const std::string& file, const KnownHead& known) {
  if (!known.mark.has_value()) return NotStored(key);
  return StoreDamaged(absl::StrCat(file, " does not hold mission ", absl::CHexEscape(key), ", but ",
                                   known.file, " knows of its ", Extent(*known.mark)));
}

absl::StatusOr<CheckedMission> LoadMission(MissionRows& rows, const KnownHead& known,
                                           const std::string& key) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<MissionRow> row, rows.Find(key));
  if (!row.has_value()) return WhyAbsent(key, rows.file(), known);
  PLUMESCOUT_RETURN_IF_ERROR(CheckAgainstMark(rows, *row, known));
  CheckedMission mission;
  mission.row = *row;
  mission.known.epoch = row->epoch;
  mission.known.head = row->head;
  mission.known.first = row->base + 1;
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.known.header, rows.Header(*row));
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.known.standing, rows.Standing(*row));
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.known.snapshots, rows.Snapshots(*row));
  return mission;
}

}  // namespace plumescout::server
