// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/observation.h"
#include "plumescout/v1/ingest_service.pb.h"

namespace plumescout {

// Sequence numbers and times above this are refused: sums of two of them cannot overflow.
inline constexpr std::int64_t kMaxSequence = std::int64_t{1} << 61;
inline constexpr std::int64_t kMaxTime_ns = std::int64_t{1} << 62;  // the year 2116
inline constexpr int kMaxBeams = 100'000;  // the most any mission may allow

// Ranges travel as counts of range_unit_m: 5 mm up to 327 m (so at most 2.5 mm of error), coarser
// only if a range is longer. +infinity becomes "no return"; NaN, -infinity and ranges <= 0 become
// "invalid".
v1::LaserScan ToProto(const Scan& scan);
v1::Observation ToProto(const Observation& observation);

// Checks form: finite numbers, whole beams, a payload, a pose (a gap may do without). What a
// mission allows (pose, range, concentration, beams) is the mission's to check.
absl::StatusOr<Scan> FromProto(const v1::LaserScan& proto, absl::string_view field);
absl::StatusOr<Observation> FromProto(const v1::Observation& proto, absl::string_view field);

// A mission's refusal of an observation, in the words of the wire.
absl::Status RefusalFromCore(const absl::Status& refusal, absl::string_view field);

}  // namespace plumescout
