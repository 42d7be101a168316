// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/outage.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kMost_s = 1e6;
constexpr double kOutageRounding_s = 1e-6;

}  // namespace

absl::Status Validate(const std::vector<Outage>& outages) {
  double free_from_s = 0.0;
  for (const Outage& outage : outages) {
    PLUMESCOUT_RETURN_IF_ERROR(
        Checker()
            .InRangeAbove("outage.at_s", outage.at_s, kOutageRounding_s, kMost_s)
            .InRangeAbove("outage.for_s", outage.for_s.value_or(kMost_s), 0.0, kMost_s)
            .status());
    if (outage.kind == OutageKind::kLinkLost && !outage.for_s) {
      return absl::InvalidArgumentError("outage.for_s must be set for a link that is lost");
    }
    if (outage.at_s < free_from_s) {
      return absl::InvalidArgumentError(absl::StrCat(
          "outage.at_s = ", outage.at_s, " must be >= ", free_from_s, ", the end of the last one"));
    }
    free_from_s = outage.end_s();
  }
  return absl::OkStatus();
}

LinkState LinkAt(const std::vector<Outage>& outages, double time_s) {
  for (const Outage& outage : outages) {
    if (!HasCome(outage.at_s, time_s) || HasCome(outage.end_s(), time_s)) continue;
    if (outage.kind == OutageKind::kLinkLost) return LinkState::kDown;
    if (outage.kind == OutageKind::kSilent) return LinkState::kGone;
  }
  return LinkState::kUp;
}

const Outage* NextAbsence(const std::vector<Outage>& outages, double time_s) {
  const auto next = std::find_if(outages.begin(), outages.end(), [time_s](const Outage& outage) {
    return outage.kind != OutageKind::kLinkLost && !HasCome(outage.end_s(), time_s);
  });
  return next == outages.end() ? nullptr : &*next;
}

bool HasCome(double due_s, double time_s) { return time_s >= due_s - kOutageRounding_s; }

}  // namespace plumescout::lab
