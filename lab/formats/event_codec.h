// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/event.h"

namespace plumescout::lab {

// What a recording begins with, as its event 0.
struct RecordingStart {
  std::string code_version;     // of the program that wrote it
  std::string mission_options;  // plumescout.v1.MissionOptions, serialised; the seed is among them

  friend bool operator==(const RecordingStart&, const RecordingStart&) = default;
};

// Events as bytes: little-endian, fixed-width numbers, lists and texts behind a 32-bit length,
// fields in the order of their declaration. Every bit of a floating-point number survives, NaN
// payloads included, so a replay of decoded events gives the same state as the originals.
//
// The layout belongs to the version of event_log.h: a new field there means a new version.
std::string EncodeEvent(const Event& event);

// kDataLoss if `bytes` end too early or too late, or hold an unknown enumerator or kind of event.
// Whether the event makes sense is for the mission to judge. Memory: O(bytes).
absl::StatusOr<Event> DecodeEvent(absl::string_view bytes);

// Likewise, as an event of number 0. kDataLoss if `bytes` are none.
std::string EncodeStart(const RecordingStart& start);
absl::StatusOr<RecordingStart> DecodeStart(absl::string_view bytes);

}  // namespace plumescout::lab
