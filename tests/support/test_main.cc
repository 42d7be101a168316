// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
//
// The main function of every test program. One program holds the tests of a folder;
// `--source=tests/core/gas/gas_map_test.cc` runs those of one file, and fails if there are none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <optional>
#include <string>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"

namespace {

// The value of --source, or nothing.
std::optional<std::string> SourceArgument(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    absl::string_view argument = argv[i];
    if (absl::ConsumePrefix(&argument, "--source=")) return std::string(argument);
  }
  return std::nullopt;
}

// The names of the tests that stand in `source`, as a filter; empty if there are none.
std::string FilterOf(const std::string& source) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string filter;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (test.file() == nullptr || !absl::EndsWith(test.file(), source)) continue;
      absl::StrAppend(&filter, filter.empty() ? "" : ":", suite.name(), ".", test.name());
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  // A filter goes before: death tests start the program again with both, for one test.
  const std::optional<std::string> source = SourceArgument(argc, argv);
  if (source.has_value() && GTEST_FLAG_GET(filter) == "*") {
    const std::string filter = FilterOf(*source);
    if (filter.empty()) {
      std::fprintf(stderr, "no test of this program stands in %s\n", source->c_str());
      return 1;
    }
    GTEST_FLAG_SET(filter, filter);
  }
  return RUN_ALL_TESTS();
}
