// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"

namespace plumescout::lab {

ProgressLine::ProgressLine(absl::Duration log_period)
    : terminal_(isatty(STDERR_FILENO) == 1), log_period_(log_period) {}

void ProgressLine::Show(const std::string& text) {
  const absl::Time now = absl::Now();
  if (terminal_) {
    std::cerr << "\r\x1b[K" << text << std::flush;
  } else if (now - last_shown_ >= log_period_) {
    std::cerr << text << std::endl;
    last_shown_ = now;
  }
}

void ProgressLine::Finish(const std::string& text) {
  if (terminal_) std::cerr << "\r\x1b[K";
  std::cerr << text << std::endl;
}

std::string ProgressBar(double fraction) {
  constexpr int kWidth = 20;
  const auto filled = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * kWidth + 0.5);
  return absl::StrCat("[", std::string(filled, '#'), std::string(kWidth - filled, '-'), "]");
}

std::string ProgressWithTimeLeft(double share, absl::Duration gone) {
  constexpr double kLeastShare = 0.01;  // before which nothing can be said of the rest
  std::string text = absl::StrFormat("%s %3.0f %%", ProgressBar(share), 100.0 * share);
  if (share > kLeastShare) {
    absl::StrAppendFormat(&text, ", %.0f s left",
                          absl::ToDoubleSeconds(gone) * (1.0 - share) / share);
  }
  return text;
}

}  // namespace plumescout::lab
