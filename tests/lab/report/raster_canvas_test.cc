// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/raster_canvas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace plumescout::lab {
namespace {

constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kBlack{0, 0, 0};
constexpr Rgb kRed{255, 0, 0};

// How much ink there is on white paper: 1 for a black pixel.
double Ink(const Image& image) {
  double ink = 0.0;
  for (const Rgb& pixel : image.pixels()) ink += 1.0 - pixel.green / 255.0;
  return ink;
}

TEST(RasterCanvas, BoxesFillWholePixels) {
  RasterCanvas canvas(10, 10, kWhite);
  canvas.FillBox({2.0, 3.0, 4.0, 2.0}, kBlack);
  EXPECT_EQ(Ink(canvas.image()), 8.0);
  EXPECT_EQ(canvas.image().At(2, 3), kBlack);
  EXPECT_EQ(canvas.image().At(5, 4), kBlack);
  EXPECT_EQ(canvas.image().At(6, 4), kWhite);
}

TEST(RasterCanvas, AHorizontalLineCoversItsWidth) {
  RasterCanvas canvas(20, 10, kWhite);
  const std::vector<PixelPoint> line = {{-5.0, 5.0}, {25.0, 5.0}};
  canvas.Polyline(line, {kBlack, 2.0});
  EXPECT_EQ(canvas.image().At(10, 4), kBlack);
  EXPECT_EQ(canvas.image().At(10, 5), kBlack);
  EXPECT_EQ(canvas.image().At(10, 3), kWhite);
  EXPECT_EQ(canvas.image().At(10, 6), kWhite);
}

TEST(RasterCanvas, ASlantedLineHasSoftEdgesAndItsOwnArea) {
  RasterCanvas canvas(100, 100, kWhite);
  const std::vector<PixelPoint> line = {{10.0, 20.0}, {90.0, 73.0}};
  constexpr double kWidth = 3.0;
  canvas.Polyline(line, {kBlack, kWidth});
  const double length = std::hypot(80.0, 53.0);
  const double area = length * kWidth + M_PI * kWidth * kWidth / 4.0;  // with round ends
  EXPECT_NEAR(Ink(canvas.image()), area, 0.03 * area);  // coverage by distance is that exact
}

TEST(RasterCanvas, JointsAreNotDarkerThanTheLine) {
  RasterCanvas straight(40, 10, kWhite);
  straight.Polyline(std::vector<PixelPoint>{{5.0, 5.3}, {35.0, 5.3}}, {kRed, 1.0});
  RasterCanvas jointed(40, 10, kWhite);
  std::vector<PixelPoint> line;
  for (int x = 5; x <= 35; ++x) line.push_back({static_cast<double>(x), 5.3});
  jointed.Polyline(line, {kRed, 1.0});
  EXPECT_EQ(jointed.image(), straight.image());
}

TEST(RasterCanvas, DashesLeaveHalfOfTheLine) {
  RasterCanvas solid(210, 9, kWhite);
  RasterCanvas dashed(210, 9, kWhite);
  const std::vector<PixelPoint> line = {{5.0, 4.5}, {105.0, 4.5}, {205.0, 4.5}};
  solid.Polyline(line, {kBlack, 1.0});
  dashed.Polyline(line, {kBlack, 1.0, 10.0});
  // Round ends add half a pixel of length on both sides of each of the ten dashes.
  EXPECT_NEAR(Ink(dashed.image()), 0.5 * Ink(solid.image()), 10.0);
}

TEST(RasterCanvas, PointsThatAreNotFinitePartTheLine) {
  RasterCanvas canvas(30, 5, kWhite);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  canvas.Polyline(
      std::vector<PixelPoint>{{2.0, 2.5}, {8.0, 2.5}, {nan, 2.5}, {20.0, 2.5}, {28.0, 2.5}},
      {kBlack, 1.0});
  EXPECT_EQ(canvas.image().At(5, 2), kBlack);
  EXPECT_EQ(canvas.image().At(14, 2), kWhite);
  EXPECT_EQ(canvas.image().At(24, 2), kBlack);
  canvas.Disc({nan, 2.0}, 3.0, kBlack);
  EXPECT_EQ(canvas.image().At(14, 2), kWhite);
}

TEST(RasterCanvas, ADiscHasItsArea) {
  RasterCanvas canvas(40, 40, kWhite);
  canvas.Disc({20.2, 19.7}, 10.0, kBlack);
  EXPECT_NEAR(Ink(canvas.image()), 100.0 * M_PI, 0.01 * 100.0 * M_PI);
  EXPECT_EQ(canvas.image().At(20, 19), kBlack);
  EXPECT_EQ(canvas.image().At(20, 31), kWhite);
}

TEST(RasterCanvas, AnchorsPlaceTheText) {
  const auto columns = [](Anchor anchor) {  // the inked ones: first and last
    RasterCanvas canvas(200, 30, kWhite);
    canvas.Text({100.0, 20.0}, "plume", {16.0, kBlack, anchor});
    int first = 200;
    int last = -1;
    for (int x = 0; x < 200; ++x) {
      for (int y = 0; y < 30; ++y) {
        if (canvas.image().At(x, y) == kWhite) continue;
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

TEST(RasterCanvas, BoldTextHasMoreInk) {
  RasterCanvas plain(100, 30, kWhite);
  RasterCanvas bold(100, 30, kWhite);
  plain.Text({5.0, 20.0}, "gas", {16.0, kBlack});
  bold.Text({5.0, 20.0}, "gas", {16.0, kBlack, Anchor::kStart, true});
  EXPECT_GT(Ink(bold.image()), 1.2 * Ink(plain.image()));
}

TEST(RasterCanvas, PicturePixelsBecomeCrispBoxes) {
  Image image(2, 1, kRed);
  image.At(1, 0) = kBlack;
  RasterCanvas canvas(10, 10, kWhite);
  canvas.Picture({1.0, 2.0, 8.0, 3.0}, image);
  for (int x = 1; x < 9; ++x) EXPECT_EQ(canvas.image().At(x, 4), x < 5 ? kRed : kBlack) << x;
  EXPECT_EQ(canvas.image().At(0, 4), kWhite);
  EXPECT_EQ(canvas.image().At(9, 4), kWhite);
  EXPECT_EQ(canvas.image().At(4, 5), kWhite);
}

TEST(RasterCanvas, WhatLiesBeyondIsCutOff) {
  RasterCanvas canvas(4, 4, kWhite);
  canvas.FillBox({-1e12, -1e12, 2.0, 2.0}, kBlack);
  canvas.Polyline(std::vector<PixelPoint>{{-1e12, 1e12}, {1e12, 1e12}}, {kBlack, 3.0});
  canvas.Disc({1e9, 0.0}, 2.0, kBlack);
  canvas.Text({50.0, 50.0}, "outside", {12.0, kBlack});
  canvas.Picture({100.0, 100.0, 5.0, 5.0}, Image(2, 2));
  canvas.Picture({0.0, 0.0, 5.0, 5.0}, Image());
  EXPECT_EQ(canvas.image(), Image(4, 4, kWhite));
}

}  // namespace
}  // namespace plumescout::lab
