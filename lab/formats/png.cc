// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/png.h"

#include <png.h>

#include <cstdint>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 26;
constexpr int kPackedRows = 0;  // libpng's word for rows without padding

// The control structure of libpng's simplified interface, freed with the scope. That interface
// returns errors instead of jumping out of our frames.
class PngControl {
 public:
  PngControl() {
    control_.version = PNG_IMAGE_VERSION;
    control_.format = PNG_FORMAT_RGB;
  }
  ~PngControl() { png_image_free(&control_); }
  PngControl(const PngControl&) = delete;
  PngControl& operator=(const PngControl&) = delete;

  png_image* operator->() { return &control_; }
  png_image* get() { return &control_; }

 private:
  png_image control_ = {};
};

}  // namespace

absl::StatusOr<std::string> EncodePng(const Image& image) {
  if (image.pixels().empty()) return absl::InvalidArgumentError("a picture needs a pixel");
  PngControl control;
  control->width = static_cast<png_uint_32>(image.width());
  control->height = static_cast<png_uint_32>(image.height());
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(*control.get());
  std::string bytes(size, '\0');
  const int written = png_image_write_to_memory(control.get(), bytes.data(), &size, 0,
                                                image.pixels().data(), kPackedRows, nullptr);
  if (written == 0) return absl::InternalError(control->message);
  bytes.resize(size);
  return bytes;
}

absl::StatusOr<Image> DecodePng(absl::string_view bytes) {
  PngControl control;
  if (png_image_begin_read_from_memory(control.get(), bytes.data(), bytes.size()) == 0) {
    return absl::DataLossError(control->message);
  }
  const std::uint64_t count = std::uint64_t{control->width} * control->height;
  if (count > kMaxPixels) {
    return absl::InvalidArgumentError(absl::StrCat(count, " pixels, at most 2^26 are read"));
  }
  control->format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(control->width), static_cast<int>(control->height));
  const png_color black = {0, 0, 0};
  if (png_image_finish_read(control.get(), &black, image.pixels().data(), kPackedRows, nullptr) ==
      0) {
    return absl::DataLossError(control->message);
  }
  return image;
}

absl::Status WritePng(const Image& image, const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string bytes, EncodePng(image));
  return WriteFile(path, bytes);
}

}  // namespace plumescout::lab
