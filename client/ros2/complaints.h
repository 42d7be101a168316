// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout::client {

// Says what is wrong with each thing every five seconds at most, and how often it was meanwhile.
class Complaints {
 public:
  static constexpr std::int64_t kSayAgain_ns = 5'000'000'000;

  explicit Complaints(std::function<void(const std::string&)> say) : say_(std::move(say)) {}

  // `about`: one of few.
  void Add(const std::string& about, const std::string& what, std::int64_t steady_ns) {
    Said& said = said_[about];
    ++said.times;
    if (said.times > 1 && steady_ns - said.at_ns < kSayAgain_ns) return;
    const std::int64_t more = said.times - said.told - 1;
    say_(absl::StrCat(about, ": ", what, more > 0 ? absl::StrCat(" (and ", more, " before)") : ""));
    said.at_ns = steady_ns;
    said.told = said.times;
  }

 private:
  struct Said {
    std::int64_t times = 0;
    std::int64_t told = 0;  // of those, when it was said last
    std::int64_t at_ns = 0;
  };

  const std::function<void(const std::string&)> say_;
  std::map<std::string, Said> said_;
};

}  // namespace plumescout::client
