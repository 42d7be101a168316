// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_history.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/journal/event_codec.h"
#include "proto/convert/event_line.h"
#include "proto/convert/field.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

constexpr int kDefaultHistorySize = 100;
constexpr int kMaxHistorySize = 1000;

// Armoured, so that nobody builds one by hand.
std::string TokenFrom(std::int64_t number) {
  return absl::WebSafeBase64Escape(absl::StrCat("#", number));
}

absl::StatusOr<std::int64_t> NumberOf(const std::string& token) {
  std::string text;
  std::int64_t number = 0;
  const bool is_number = absl::WebSafeBase64Unescape(token, &text) && !text.empty() &&
                         text.front() == '#' && absl::SimpleAtoi(text.substr(1), &number);
  if (!is_number || number < 1) return FieldError("page_token", token, "is no token of a history");
  return number;
}

}  // namespace

absl::StatusOr<HistoryPage> HistoryPageFromProto(const v1::GetMissionHistoryRequest& request) {
  HistoryPage page;
  for (int i = 0; i < request.kinds_size(); ++i) {
    const int kind = request.kinds(i);
    if (kind == v1::MISSION_EVENT_KIND_UNSPECIFIED || !v1::MissionEventKind_IsValid(kind)) {
      return FieldError(Join("", "kinds", i), kind, "is no kind of event");
    }
    page.kinds.insert(kind);
  }
  if (request.first_number() < 0) {
    return FieldError("first_number", static_cast<double>(request.first_number()), "must be >= 0");
  }
  page.first_number = std::max<std::int64_t>(1, request.first_number());
  if (request.page_size() < 0) {
    return FieldError("page_size", request.page_size(), "must be >= 0");
  }
  page.size = request.page_size() == 0 ? kDefaultHistorySize
                                       : std::min(request.page_size(), kMaxHistorySize);
  if (!request.page_token().empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(page.first_number, NumberOf(request.page_token()));
  }
  return page;
}

absl::StatusOr<v1::GetMissionHistoryResponse> ReadHistory(MissionStore& store,
                                                          const std::string& key,
                                                          const MissionId& mission,
                                                          const HistoryPage& page,
                                                          const StopFn& stop) {
  v1::GetMissionHistoryResponse response;
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission stored, store.Peek(key));
  response.set_head_revision(stored.head);
  response.set_first_number(stored.first);
  const std::int64_t first = std::max(page.first_number, stored.first);
  if (first > stored.head) return response;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<JournalReader> reader, store.Read(key, first));
  std::int64_t next = first;
  for (int looked_at = 0; next <= stored.head; ++looked_at) {
    if (looked_at == kMaxEventsLookedAt || response.events_size() == page.size) {
      response.set_next_page_token(TokenFrom(next));
      break;
    }
    if (Stops(stop)) return GivenUp();
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<JournalRecord> record, reader->Next());
    if (!record.has_value()) break;
    PLUMESCOUT_ASSIGN_OR_RETURN(const Event event, DecodeEvent(record->bytes));
    next = record->number + 1;
    if (!page.kinds.empty() && page.kinds.count(KindOf(event.body)) == 0) continue;
    *response.add_events() = ToProto(event, mission);
  }
  return response;
}

}  // namespace plumescout::server
