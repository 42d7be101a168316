// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/cairo_image.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace plumescout::lab {
namespace {

// CAIRO_FORMAT_RGB24: 32-bit numbers, blue in the lowest byte.
constexpr int kRed = 16;
constexpr int kGreen = 8;

std::size_t Offset(cairo_surface_t* surface, int x, int y) {
  return static_cast<std::size_t>(y) *
             static_cast<std::size_t>(cairo_image_surface_get_stride(surface)) +
         static_cast<std::size_t>(x) * sizeof(std::uint32_t);
}

}  // namespace

CairoSurface ToCairo(const Image& image) {
  CairoSurface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width(), image.height()));
  cairo_surface_flush(surface.get());
  unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb color = image.At(x, y);
      const std::uint32_t pixel =
          (std::uint32_t{color.red} << kRed) | (std::uint32_t{color.green} << kGreen) | color.blue;
      std::memcpy(bytes + Offset(surface.get(), x, y), &pixel, sizeof(pixel));
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Image FromCairo(cairo_surface_t* surface) {
  const auto byte = [](std::uint32_t pixel) { return static_cast<std::uint8_t>(pixel & 0xFFU); };
  cairo_surface_flush(surface);
  const unsigned char* const bytes = cairo_image_surface_get_data(surface);
  Image image(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, bytes + Offset(surface, x, y), sizeof(pixel));
      image.At(x, y) = {byte(pixel >> kRed), byte(pixel >> kGreen), byte(pixel)};
    }
  }
  return image;
}

}  // namespace plumescout::lab
