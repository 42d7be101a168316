// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/event.h"

namespace plumescout::lab {

// Events as bytes: little-endian, fixed-width numbers, lists and texts behind a 32-bit length,
// fields in the order of their declaration. Every bit of a floating-point number survives, NaN
// payloads included, so a replay of decoded events gives the same state as the originals.
//
// The layout belongs to the version of event_log.h: a new field there means a new version.
std::string EncodeEvent(const Event& event);

// kDataLoss if `bytes` end too early or too late, or hold an unknown enumerator or kind of event.
// Whether the event makes sense is for the mission to judge. Memory: O(bytes).
absl::StatusOr<Event> DecodeEvent(absl::string_view bytes);

}  // namespace plumescout::lab
