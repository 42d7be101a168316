// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/png.h"

#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/report/cairo_image.h"

namespace plumescout::lab {

absl::StatusOr<std::string> EncodePng(const Image& image) {
  if (image.pixels().empty()) return absl::InvalidArgumentError("a picture needs a pixel");
  const CairoSurface surface = ToCairo(image);
  std::string bytes;
  const auto append = [](void* text, const unsigned char* part, unsigned int count) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(part), count);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) {
    return absl::InternalError(cairo_status_to_string(status));
  }
  return bytes;
}

absl::Status WritePng(const Image& image, const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string bytes, EncodePng(image));
  return WriteFile(path, bytes);
}

}  // namespace plumescout::lab
