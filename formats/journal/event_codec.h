// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/event.h"

namespace plumescout {

// What a journal begins with, as its event 0.
struct JournalStart {
  std::string code_version = {};  // of the program that began it
  std::string mission_options =
      {};  // plumescout.v1.MissionOptions, serialised; the seed is among them
  // Empty or 0 in recordings of studies.
  std::string mission = {};
  std::string owner = {};
  std::string tenant = {};
  std::int64_t created_ns = 0;  // since the Unix epoch
  // Of a mission that was copied whole up to an event: its number, and Mission::Digest there.
  std::int64_t last_number = 0;
  std::uint64_t last_digest = 0;  // 0: not known

  friend bool operator==(const JournalStart&, const JournalStart&) = default;
};

// What is kept of a plan.
enum class PlanDetail {
  kWhole,
  kForReplay,  // what a mission and its fleet need: the chosen candidate, but not those it was
               // chosen from; of the rejected goals only the first that others were in the way of
};

// Events as bytes. Whatever a mission reads of an event survives bit by bit, so a replay of decoded
// events gives the same state as the originals. Scans whose ranges are multiples of a common step
// take about one byte a beam, others four.
//
// A record begins with a byte for its version and one for its kind: new fields mean a new version
// of that kind, and decoders of older ones stay. Then come its number and its fields in the order
// of their declaration: whole numbers as varints (varint.h), other numbers as they are,
// little-endian, ranges as of range_codec.h.
std::string EncodeEvent(const Event& event, PlanDetail detail = PlanDetail::kWhole);

// kDataLoss if `bytes` end too early or too late, or hold an unknown enumerator, kind or version
// (which is then named). Whether the event makes sense is for the mission to judge. Memory:
// O(bytes).
absl::StatusOr<Event> DecodeEvent(absl::string_view bytes);

// Likewise, as an event of number 0. kDataLoss if `bytes` are none.
std::string EncodeStart(const JournalStart& start);
absl::StatusOr<JournalStart> DecodeStart(absl::string_view bytes);

}  // namespace plumescout
