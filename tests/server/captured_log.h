// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "absl/time/time.h"
#include "server/base/log.h"

namespace plumescout::server {

// What is logged while `act` runs.
inline std::string LogOf(const std::function<void()>& act) {
  constexpr absl::Duration kPatience = absl::Seconds(60);
  EXPECT_TRUE(FlushLog(kPatience));
  testing::internal::CaptureStderr();
  act();
  EXPECT_TRUE(FlushLog(kPatience));
  return testing::internal::GetCapturedStderr();
}

}  // namespace plumescout::server
