// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/svg_canvas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "absl/strings/escaping.h"
#include "lab/formats/png.h"

namespace plumescout::lab {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr Rgb kRed{255, 16, 0};

TEST(SvgCanvas, AnEmptyElementHasSizeAndTitle) {
  const std::string svg = SvgCanvas(30, 20, "a < b").Element();
  EXPECT_THAT(svg, StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 30 20\""));
  EXPECT_THAT(svg, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(svg, EndsWith("</svg>\n"));
}

TEST(SvgCanvas, ShapesBecomeElements) {
  SvgCanvas canvas(30, 20, "");
  canvas.FillBox({1, 2, 3, 4}, kRed);
  canvas.Disc({5, 6}, 7, kRed);
  EXPECT_THAT(
      canvas.Element(),
      HasSubstr("<rect x=\"1.00\" y=\"2.00\" width=\"3.00\" height=\"4.00\" fill=\"#ff1000\"/>"));
  EXPECT_THAT(canvas.Element(),
              HasSubstr("<circle cx=\"5.00\" cy=\"6.00\" r=\"7.00\" fill=\"#ff1000\"/>"));
}

TEST(SvgCanvas, PointsThatAreNotFinitePartTheLine) {
  SvgCanvas canvas(30, 20, "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  canvas.Polyline(std::vector<PixelPoint>{{1, 1}, {2, 2}, {nan, 3}, {4, 4}, {5, 5}}, {kRed, 1, 3});
  EXPECT_THAT(canvas.Element(), HasSubstr("M1.00 1.00L2.00 2.00M4.00 4.00L5.00 5.00"));
  EXPECT_THAT(canvas.Element(), HasSubstr("stroke-dasharray=\"3.00\""));
}

TEST(SvgCanvas, NothingIsDrawnForNothing) {
  SvgCanvas canvas(30, 20, "");
  const std::string empty = canvas.Element();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  canvas.Polyline(std::vector<PixelPoint>{}, {});
  canvas.Disc({nan, 0}, 1, kRed);
  canvas.Picture({0, 0, 1, 1}, Image());
  EXPECT_EQ(canvas.Element(), empty);
}

TEST(SvgCanvas, TextIsEscaped) {
  SvgCanvas canvas(30, 20, "");
  canvas.Text({1, 2}, "<script>&\"'", {12, kRed, Anchor::kEnd, true});
  EXPECT_THAT(canvas.Element(), HasSubstr("&lt;script&gt;&amp;&quot;&#39;</text>"));
  EXPECT_THAT(canvas.Element(), HasSubstr("text-anchor=\"end\" font-weight=\"bold\""));
  EXPECT_THAT(canvas.Element(), Not(HasSubstr("<script>")));
}

TEST(SvgCanvas, PicturesAreEmbedded) {
  Image image(3, 2, kRed);
  SvgCanvas canvas(30, 20, "");
  canvas.Picture({0, 0, 30, 20}, image);
  const std::string svg = canvas.Element();
  const std::string prefix = "data:image/png;base64,";
  const std::size_t begin = svg.find(prefix) + prefix.size();
  std::string png;
  ASSERT_TRUE(absl::Base64Unescape(svg.substr(begin, svg.find('"', begin) - begin), &png));
  EXPECT_EQ(*DecodePng(png), image);
}

}  // namespace
}  // namespace plumescout::lab
