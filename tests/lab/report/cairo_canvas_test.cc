// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/cairo_canvas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace plumescout::lab {
namespace cairo_canvas_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kBlack{0, 0, 0};
constexpr Rgb kRed{255, 0, 0};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// How much ink there is on white paper: 1 for a black pixel.
double Ink(const Image& image) {
  double ink = 0.0;
  for (const Rgb& pixel : image.pixels()) ink += 1.0 - pixel.green / 255.0;
  return ink;
}

Image DrawLine(int width_px, int height_px, const std::vector<PixelPoint>& line,
               const Stroke& stroke) {
  return DrawImage(width_px, height_px, kWhite,
                   [&](Canvas& canvas) { canvas.Polyline(line, stroke); });
}

Image DrawText(const std::string& text, const TextStyle& style) {
  return DrawImage(200, 30, kWhite, [&](Canvas& canvas) {
    canvas.Text({100.0, 20.0}, text, style);
  });
}

// One of everything.
void DrawAll(Canvas& canvas) {
  canvas.FillBox({1.0, 2.0, 3.0, 4.0}, kRed);
  canvas.Polyline(std::vector<PixelPoint>{{1.0, 1.0}, {20.0, 10.0}}, {kBlack, 1.5, 3.0});
  canvas.Disc({30.0, 10.0}, 5.0, kRed);
  canvas.Text({5.0, 25.0}, "14.9 ± 1.9 ppm² – a < b", {9.0, kBlack});
  canvas.Picture({50.0, 0.0, 30.0, 20.0}, Image(3, 2, kRed));
}

TEST(CairoImages, BoxesFillWholePixels) {
  const Image image = DrawImage(10, 10, kWhite, [](Canvas& canvas) {
    canvas.FillBox({2.0, 3.0, 4.0, 2.0}, kBlack);
  });
  EXPECT_EQ(Ink(image), 8.0);
  EXPECT_EQ(image.At(2, 3), kBlack);
  EXPECT_EQ(image.At(5, 4), kBlack);
  EXPECT_EQ(image.At(6, 4), kWhite);
}

TEST(CairoImages, AScaleMakesMorePixelsOfTheSameDrawing) {
  const auto draw = [](Canvas& canvas) { canvas.FillBox({2.0, 3.0, 4.0, 2.0}, kBlack); };
  const Image image = DrawImage(10, 10, kWhite, draw, 2.0);
  EXPECT_EQ(image.width(), 20);
  EXPECT_EQ(Ink(image), 32.0);
  EXPECT_EQ(image.At(4, 6), kBlack);
}

TEST(CairoImages, LinesAreAsWideAsTheirStroke) {
  const Image image = DrawLine(20, 10, {{-5.0, 5.0}, {25.0, 5.0}}, {kBlack, 2.0});
  EXPECT_EQ(image.At(10, 4), kBlack);
  EXPECT_EQ(image.At(10, 5), kBlack);
  EXPECT_EQ(image.At(10, 3), kWhite);
  EXPECT_EQ(image.At(10, 6), kWhite);
}

TEST(CairoImages, DashesLeaveHalfOfTheLine) {
  const std::vector<PixelPoint> line = {{5.0, 4.5}, {105.0, 4.5}, {205.0, 4.5}};
  const double solid = Ink(DrawLine(210, 9, line, {kBlack, 1.0}));
  // Round ends add half a pixel of length on both sides of each of the ten dashes.
  EXPECT_NEAR(Ink(DrawLine(210, 9, line, {kBlack, 1.0, 10.0})), 0.5 * solid, 10.0);
}

TEST(CairoImages, PointsThatAreNotFinitePartTheLine) {
  const Image image = DrawLine(
      30, 5, {{2.0, 2.5}, {8.0, 2.5}, {kNan, 2.5}, {20.0, 2.5}, {28.0, 2.5}}, {kBlack, 1.0});
  EXPECT_EQ(image.At(5, 2), kBlack);
  EXPECT_EQ(image.At(14, 2), kWhite);
  EXPECT_EQ(image.At(24, 2), kBlack);
}

TEST(CairoImages, ADiscHasItsArea) {
  const Image image = DrawImage(40, 40, kWhite, [](Canvas& canvas) {
    canvas.Disc({20.2, 19.7}, 10.0, kBlack);
  });
  EXPECT_NEAR(Ink(image), 100.0 * M_PI, 0.01 * 100.0 * M_PI);
}

TEST(CairoImages, AnchorsPlaceTheText) {
  const auto columns = [](Anchor anchor) {  // the inked ones: first and last
    const Image image = DrawText("plume", {16.0, kBlack, anchor});
    int first = 200;
    int last = -1;
    for (int x = 0; x < 200; ++x) {
      for (int y = 0; y < 30; ++y) {
        if (image.At(x, y) == kWhite) continue;
        first = std::min(first, x);
        last = std::max(last, x);
      }
    }
    return std::pair(first, last);
  };
  EXPECT_NEAR(columns(Anchor::kStart).first, 100, 2);
  EXPECT_NEAR(columns(Anchor::kEnd).second, 100, 2);
  const auto [first, last] = columns(Anchor::kMiddle);
  EXPECT_NEAR(0.5 * (first + last), 99.5, 2);
}

TEST(CairoImages, BoldTextHasMoreInk) {
  EXPECT_GT(Ink(DrawText("gas", {16.0, kBlack, Anchor::kStart, true})),
            1.2 * Ink(DrawText("gas", {16.0, kBlack})));
}

TEST(CairoImages, TextThatIsNoUtf8DoesNotEndTheDrawing) {
  const Image image = DrawImage(60, 30, kWhite, [](Canvas& canvas) {
    canvas.Text({5.0, 20.0}, "\xFF\xFE", {16.0, kRed});
    canvas.FillBox({0.0, 0.0, 2.0, 2.0}, kBlack);
  });
  EXPECT_EQ(image.At(1, 1), kBlack);
}

TEST(CairoImages, PicturePixelsBecomeCrispBoxes) {
  Image picture(2, 1, kRed);
  picture.At(1, 0) = kBlack;
  const Image image = DrawImage(10, 10, kWhite, [&](Canvas& canvas) {
    canvas.Picture({1.0, 2.0, 8.0, 3.0}, picture);
  });
  for (int x = 1; x < 9; ++x) EXPECT_EQ(image.At(x, 4), x < 5 ? kRed : kBlack) << x;
  EXPECT_EQ(image.At(0, 4), kWhite);
  EXPECT_EQ(image.At(9, 4), kWhite);
  EXPECT_EQ(image.At(4, 5), kWhite);
}

TEST(CairoImages, WhatLiesBeyondIsCutOffAndNothingIsNothing) {
  const Image image = DrawImage(4, 4, kWhite, [](Canvas& canvas) {
    canvas.FillBox({-1e12, -1e12, 2.0, 2.0}, kBlack);
    canvas.Polyline(std::vector<PixelPoint>{{-1e12, 1e12}, {1e12, 1e12}}, {kBlack, 3.0});
    canvas.Polyline(std::vector<PixelPoint>{}, {kBlack, 3.0});
    canvas.Disc({1e9, 0.0}, 2.0, kBlack);
    canvas.Disc({kNan, 2.0}, 3.0, kBlack);
    canvas.Text({50.0, 50.0}, "outside", {12.0, kBlack});
    canvas.Picture({100.0, 100.0, 5.0, 5.0}, Image(2, 2));
    canvas.Picture({0.0, 0.0, 5.0, 5.0}, Image());
  });
  EXPECT_EQ(image, Image(4, 4, kWhite));
}

TEST(CairoSvg, IsADocumentWithCrispPicturesThatLoadsNothing) {
  const std::string svg = DrawSvg(90, 30, DrawAll);
  EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 90 30\""));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(svg, HasSubstr("<image style=\"image-rendering:pixelated\" id=\"image"));
  EXPECT_THAT(svg, Not(HasSubstr("href=\"http")));
  EXPECT_THAT(svg, Not(HasSubstr("<pattern")));  // would be blurred
}

TEST(CairoSvg, TheSameDrawingGivesTheSameBytesWhateverWasDrawnBefore) {
  const std::string first = DrawSvg(90, 30, DrawAll);
  DrawSvg(10, 10, [](Canvas& canvas) { canvas.FillBox({0.0, 0.0, 5.0, 5.0}, kRed); });
  EXPECT_EQ(DrawSvg(90, 30, DrawAll), first);
  EXPECT_EQ(DrawImage(90, 30, kWhite, DrawAll), DrawImage(90, 30, kWhite, DrawAll));
}

}  // namespace cairo_canvas_test
}  // namespace plumescout::lab
