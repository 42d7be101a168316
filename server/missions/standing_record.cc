// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/standing_record.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout::server {
namespace {

using Json = nlohmann::json;

constexpr int kStandingVersion = 1;
constexpr char kVersionKey[] = "version";
constexpr char kStateKey[] = "state";
constexpr char kIdleKey[] = "idle_time_to_live_ns";
constexpr char kReleasedKey[] = "released_leases";
constexpr char kRetentionKey[] = "event_retention";
constexpr char kSinceSnapshot[] = "since_snapshot";

constexpr std::pair<MissionState, const char*> kStateNames[] = {
    {MissionState::kRunning, "running"},
    {MissionState::kPaused, "paused"},
    {MissionState::kFinished, "finished"}};

const char* NameOfState(MissionState state) {
  for (const auto& [value, name] : kStateNames) {
    if (value == state) return name;
  }
  return "";
}

std::optional<MissionState> StateOfName(const Json& json) {
  for (const auto& [value, name] : kStateNames) {
    if (json.is_string() && json.get_ref<const std::string&>() == name) return value;
  }
  return std::nullopt;
}

absl::Status NoStanding(absl::string_view what) {
  return absl::DataLossError(absl::StrCat("the mission's standing: ", what));
}

}  // namespace

std::string EncodeStanding(const StandingRecord& record) {
  Json json = {{kVersionKey, kStandingVersion}, {kStateKey, NameOfState(record.state)}};
  if (record.idle_time_to_live != absl::InfiniteDuration()) {
    json[kIdleKey] = absl::ToInt64Nanoseconds(record.idle_time_to_live);
  }
  if (record.event_retention == EventRetention::kSinceSnapshot) {
    json[kRetentionKey] = kSinceSnapshot;
  }
  for (const auto& [robot, token] : record.released_leases) json[kReleasedKey][robot] = token;
  return json.dump();
}

absl::StatusOr<StandingRecord> DecodeStanding(absl::string_view bytes) {
  StandingRecord record;
  if (bytes.empty()) return record;
  const Json json = Json::parse(bytes.begin(), bytes.end(), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.value(kVersionKey, Json()).is_number_integer()) {
    return NoStanding("no record with a version");
  }
  const auto version = json[kVersionKey].get<std::int64_t>();
  if (version > kStandingVersion) {
    return absl::FailedPreconditionError(absl::StrCat(
        "the mission's standing has version ", version, "; this program knows ", kStandingVersion));
  }
  const auto state = StateOfName(json.value(kStateKey, Json()));
  if (!state) return NoStanding("state is none of running, paused, finished");
  record.state = *state;
  if (json.contains(kIdleKey)) {
    if (!json[kIdleKey].is_number_integer()) return NoStanding("no idle_time_to_live_ns");
    record.idle_time_to_live = absl::Nanoseconds(json[kIdleKey].get<std::int64_t>());
  }
  if (json.contains(kRetentionKey)) {
    if (json[kRetentionKey] != kSinceSnapshot) return NoStanding("no event_retention");
    record.event_retention = EventRetention::kSinceSnapshot;
  }
  const Json released = json.value(kReleasedKey, Json::object());
  if (!released.is_object()) return NoStanding("no released_leases");
  for (const auto& [robot, token] : released.items()) {
    if (!token.is_number_integer()) return NoStanding("no token in released_leases");
    record.released_leases[robot] = token.get<std::int64_t>();
  }
  return record;
}

}  // namespace plumescout::server
