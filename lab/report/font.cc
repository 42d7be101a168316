// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/font.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "lab/report/cairo_handles.h"

namespace plumescout::lab {

void SelectFont(cairo_t* context, double size_px, bool bold) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size_px);
  const CairoFontOptions options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options.get());
}

std::string Writable(absl::string_view text) {
  using Json = nlohmann::json;
  std::string utf8(text);
  if (std::all_of(utf8.begin(), utf8.end(), absl::ascii_isascii)) return utf8;
  return Json::parse(Json(utf8).dump(-1, ' ', false, Json::error_handler_t::replace));
}

double TextWidth_px(absl::string_view utf8, double size_px, bool bold) {
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext context(cairo_create(surface.get()));
  SelectFont(context.get(), size_px, bold);
  cairo_text_extents_t extents{};
  cairo_text_extents(context.get(), Writable(utf8).c_str(), &extents);
  return extents.x_advance;
}

double SizeToFit_px(absl::string_view utf8, double size_px, double width_px, bool bold) {
  const double needed_px = TextWidth_px(utf8, size_px, bold);
  return needed_px > width_px ? size_px * std::max(0.0, width_px) / needed_px : size_px;
}

std::vector<std::string> WrapText(absl::string_view utf8, double size_px, double width_px) {
  std::vector<std::string> lines;
  for (const absl::string_view word : absl::StrSplit(utf8, ' ', absl::SkipEmpty())) {
    const std::string longer =
        lines.empty() ? std::string(word) : absl::StrCat(lines.back(), " ", word);
    if (!lines.empty() && TextWidth_px(longer, size_px) <= width_px) {
      lines.back() = longer;
    } else {
      lines.emplace_back(word);
    }
  }
  return lines;
}

}  // namespace plumescout::lab
