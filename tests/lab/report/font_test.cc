// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/font.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plumescout::lab {
namespace font_test {

constexpr double kSize_px = 14.0;

TEST(Font, TextGrowsByItsCharactersAndItsSize) {
  EXPECT_EQ(TextWidth_px("", kSize_px), 0.0);
  EXPECT_NEAR(TextWidth_px("HH", kSize_px), 2.0 * TextWidth_px("H", kSize_px), 1e-6);
  EXPECT_NEAR(TextWidth_px("wide", 2.0 * kSize_px), 2.0 * TextWidth_px("wide", kSize_px), 0.05);
  EXPECT_GT(TextWidth_px("gas", kSize_px, true), TextWidth_px("gas", kSize_px));
}

TEST(Font, DigitsAreEquallyWideSoThatColumnsAlign) {
  for (const char* digit : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    EXPECT_EQ(TextWidth_px(digit, kSize_px), TextWidth_px("0", kSize_px)) << digit;
  }
}

TEST(Font, ACharacterOfSeveralBytesIsOne) {
  EXPECT_NEAR(TextWidth_px("±", kSize_px), TextWidth_px("+", kSize_px), 2.0);
}

TEST(Font, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(Writable("a² – b"), "a² – b");
  EXPECT_EQ(Writable("a\xFF"), "a\uFFFD");
  EXPECT_EQ(Writable("\"\\\n\xFF"), "\"\\\n\uFFFD");
  EXPECT_GT(TextWidth_px("\xE2\x82", kSize_px), 0.0);
}

TEST(Font, ShrinksWhatIsTooWide) {
  EXPECT_EQ(SizeToFit_px("gas", kSize_px, 200.0), kSize_px);
  const double size_px = SizeToFit_px("a long title", kSize_px, 40.0, true);
  EXPECT_NEAR(TextWidth_px("a long title", size_px, true), 40.0, 0.5);
  EXPECT_EQ(SizeToFit_px("gas", kSize_px, -1.0), 0.0);
}

TEST(Font, WrapsTextIntoLinesThatFit) {
  constexpr double kWidth_px = 120.0;
  const std::string text = "the quick brown fox jumps over the lazy dog";
  std::string joined;
  const std::vector<std::string> lines = WrapText(text, kSize_px, kWidth_px);
  EXPECT_GT(lines.size(), 1u);
  for (const std::string& line : lines) {
    EXPECT_LE(TextWidth_px(line, kSize_px), kWidth_px);
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
  EXPECT_EQ(WrapText("unbreakable", kSize_px, 1.0), std::vector<std::string>{"unbreakable"});
  EXPECT_TRUE(WrapText("", kSize_px, kWidth_px).empty());
}

}  // namespace font_test
}  // namespace plumescout::lab
