// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/time/time.h"

namespace plumescout::lab {

// One line of progress on standard error. On a terminal it is drawn over; elsewhere a new line is
// printed now and then, so that logs stay short.
class ProgressLine {
 public:
  explicit ProgressLine(absl::Duration log_period = absl::Seconds(5));

  void Show(const std::string& text);
  // Shows the text for good and ends the line.
  void Finish(const std::string& text);

 private:
  const bool terminal_;
  const absl::Duration log_period_;
  absl::Time last_shown_ = absl::InfinitePast();
};

// "[######----]" for a fraction in [0, 1].
std::string ProgressBar(double fraction);

// "[####----]  40 %, 12 s left", the rest taken to go as fast as what is done. REQUIRES: `share` in
// [0, 1].
std::string ProgressWithTimeLeft(double share, absl::Duration gone);

}  // namespace plumescout::lab
