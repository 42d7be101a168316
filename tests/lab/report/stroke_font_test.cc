// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/stroke_font.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace plumescout::lab {
namespace {

constexpr double kSize_px = 100.0;
constexpr double kCapital_px = 72.0;
constexpr double kDescender_px = 24.0;

constexpr const char* kSigns[] = {"\u00B1", "\u00B2", "\u2013"};

// All numbers of the lines, to tell characters apart.
std::string Shape(const std::string& text) {
  std::string shape;
  for (const auto& line : WriteText(text, kSize_px)) {
    for (const PixelPoint& point : line) {
      shape += std::to_string(point.x) + "," + std::to_string(point.y) + " ";
    }
    shape += "/";
  }
  return shape;
}

TEST(StrokeFont, EveryPrintableCharacterHasItsOwnShape) {
  std::set<std::string> shapes;
  for (char c = '!'; c <= '~'; ++c) shapes.insert(Shape(std::string(1, c)));
  for (const char* sign : kSigns) shapes.insert(Shape(sign));
  EXPECT_EQ(shapes.size(), static_cast<std::size_t>('~' - '!' + 1) + std::size(kSigns));
  EXPECT_EQ(shapes.count(Shape("\x01")), 0U);  // the box
}

TEST(StrokeFont, EveryCharacterStaysOnItsLine) {
  std::vector<std::string> texts(std::begin(kSigns), std::end(kSigns));
  for (char c = '!'; c <= '~'; ++c) texts.emplace_back(1, c);
  for (const std::string& text : texts) {
    for (const auto& line : WriteText(text, kSize_px)) {
      for (const PixelPoint& point : line) {
        EXPECT_GE(point.x, 0.0) << text;
        EXPECT_LE(point.x, TextWidth_px(text, kSize_px)) << text;
        EXPECT_GE(point.y, -kCapital_px - 6.0) << text;  // brackets rise a unit above
        EXPECT_LE(point.y, kDescender_px) << text;
      }
    }
  }
}

TEST(StrokeFont, CapitalsStandOnTheBaseline) {
  double top = 0.0;
  double bottom = -kCapital_px;
  for (const auto& line : WriteText("H", kSize_px)) {
    for (const PixelPoint& point : line) {
      top = std::min(top, point.y);
      bottom = std::max(bottom, point.y);
    }
  }
  EXPECT_DOUBLE_EQ(top, -kCapital_px);
  EXPECT_DOUBLE_EQ(bottom, 0.0);
}

TEST(StrokeFont, TextGrowsByItsCharacters) {
  EXPECT_DOUBLE_EQ(TextWidth_px("", kSize_px), 0.0);
  EXPECT_TRUE(WriteText(" ", kSize_px).empty());
  EXPECT_GT(TextWidth_px("HH", kSize_px), 2.0 * TextWidth_px("H", kSize_px));
  EXPECT_DOUBLE_EQ(TextWidth_px("wide", 2.0 * kSize_px), 2.0 * TextWidth_px("wide", kSize_px));
}

TEST(StrokeFont, DigitsAreEquallyWideSoThatColumnsAlign) {
  for (const char* digit : {"0", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    EXPECT_DOUBLE_EQ(TextWidth_px(digit, kSize_px), TextWidth_px("0", kSize_px)) << digit;
  }
}

TEST(StrokeFont, OtherCharactersAreOneBoxEach) {
  EXPECT_EQ(Shape("\u20AC"), Shape("\u4E2D"));
  EXPECT_EQ(WriteText("a\u20AC", kSize_px).size(), WriteText("a", kSize_px).size() + 1);
  EXPECT_NE(Shape("\u00B2"), Shape("\u20AC"));
}

TEST(StrokeFont, BytesThatAreNoUtf8AreBoxesToo) {
  EXPECT_EQ(WriteText("\xFF\xFE", kSize_px).size(), 2U);
  EXPECT_EQ(WriteText("\xE2\x82", kSize_px).size(), 1U);
}

TEST(StrokeFont, WrapsTextIntoLinesThatFit) {
  constexpr double kSize_px = 14.0;
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

}  // namespace
}  // namespace plumescout::lab
