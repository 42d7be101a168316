// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/server/bad_input.h"

namespace plumescout::server {

// A strategy that samples sites is chosen where it takes one to see what is wrong.
inline BadInputs BadSiteOptions() {
  const std::string s = "options.planning.sites.";
  BadInputs rows;
  rows.Values(s + "spacing_m", {"nan", "inf", "-1", "0", "0.04", "1001"})
      .Values(s + "reward", {"-1", "99"})
      .Values(s + "survey_stride", {"-1", "0", "1001"})
      .Values(s + "candidate_count", {"-1", "0", "17"})
      .Values(s + "cycle_sample_count", {"-1", "0", "16"})
      .Values(s + "update_period_s", {"nan", "inf", "-1", "0", "1e300"})
      .Values(s + "sweep_stride", {"-1", "0", "1001"})
      .Values(s + "sweep_leg_stride", {"-1", "0", "1001"})
      .ValuesBlaming(s + "region.min", s + "region", {"{}", "{max {x_m: 1}}"})
      .ValuesBlaming(s + "region.max", s + "region.min", {"{}"})
      .ValuesBlaming(s + "region.min", s + "region.max", {"{}"});
  for (const char* corner : {"min", "max"}) {
    for (const char* axis : {"x_m", "y_m"}) {
      for (const char* value : {"nan", "-inf", "-1e300"}) {
        const std::string field = absl::StrCat(s, "region.", corner, ".", axis);
        const auto spoil = [=](Message& message) {
          SetField(message, s + "region", "{min {} max {x_m: 1 y_m: 1}}");
          SetField(message, field, value);
        };
        rows.Row({field, value, spoil, absl::StatusCode::kInvalidArgument, field});
      }
    }
  }
  const auto lhr = [&](const std::string& field, const char* what, const std::string& value) {
    const auto spoil = [=](Message& message) {
      SetField(message, "options.planning.strategy", R"("lhr")");
      SetField(message, "options.planning.sites.region", "{min {} max {x_m: 51 y_m: 51}}");
      SetField(message, "options.planning.sites." + field, value);
    };
    rows.Row({s + field, what, spoil, absl::StatusCode::kInvalidArgument, s + field});
  };
  lhr("survey_stride", "does not divide the region", "7");
  lhr("survey_stride", "a survey of 2601 sites", "1");
  lhr("update_period_s", "below the bound of Remark 1", "3.9");
  lhr("cycle_sample_count", "T > M", "16");
  lhr("reward", "per time", "SAMPLING_REWARD_VARIANCE_PER_TIME");
  lhr("region", "no whole squares", "{min {} max {x_m: 50.5 y_m: 51}}");
  lhr("region", "a line", "{min {} max {x_m: 51 y_m: 0}}");
  lhr("region", "four million sites", "{min {} max {x_m: 2000 y_m: 2000}}");
  for (const char* strategy : {R"("lhr")", R"("random_sampling")", R"("sweep")"}) {
    rows.Row({s + "region", absl::StrCat("none, with strategy ", strategy),
              [=](Message& message) { SetField(message, "options.planning.strategy", strategy); },
              absl::StatusCode::kInvalidArgument, s + "region"});
  }
  return rows;
}

}  // namespace plumescout::server
