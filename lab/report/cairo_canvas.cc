// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/cairo_canvas.h"

#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>

#include "absl/strings/str_cat.h"
#include "lab/report/cairo_handles.h"
#include "lab/report/cairo_image.h"
#include "lab/report/font.h"

namespace plumescout::lab {
namespace {

// Cairo counts in 24-bit pixels.
double Bounded(double coordinate) {
  constexpr double kFar_px = 1e6;
  return std::clamp(coordinate, -kFar_px, kFar_px);
}

bool IsFinite(PixelPoint point) { return std::isfinite(point.x) && std::isfinite(point.y); }

class CairoCanvas final : public Canvas {
 public:
  // The context outlives the canvas.
  explicit CairoCanvas(cairo_t* context) : context_(context) {}

  // Edges lie between pixels.
  void FillBox(const PixelBox& box, Rgb color) override {
    const double left = Bounded(std::round(box.x));
    const double top = Bounded(std::round(box.y));
    SetColor(color);
    cairo_rectangle(context_, left, top, Bounded(std::round(box.right())) - left,
                    Bounded(std::round(box.bottom())) - top);
    cairo_fill(context_);
  }

  void Polyline(std::span<const PixelPoint> points, const Stroke& stroke) override {
    bool pen_down = false;
    for (const PixelPoint& point : points) {
      const bool finite = IsFinite(point);
      const auto go = pen_down ? cairo_line_to : cairo_move_to;
      if (finite) go(context_, Bounded(point.x), Bounded(point.y));
      pen_down = finite;
    }
    SetColor(stroke.color);
    cairo_set_line_width(context_, stroke.width_px);
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(context_, &stroke.dash_px, stroke.dash_px > 0.0 ? 1 : 0, 0.0);
    cairo_stroke(context_);
  }

  void Disc(PixelPoint center, double radius_px, Rgb color) override {
    if (!IsFinite(center)) return;
    SetColor(color);
    cairo_arc(context_, Bounded(center.x), Bounded(center.y), radius_px, 0.0,
              2.0 * std::numbers::pi);
    cairo_fill(context_);
  }

  void Text(PixelPoint baseline, absl::string_view utf8, const TextStyle& style) override {
    const double width_px = TextWidth_px(utf8, style.size_px, style.bold);
    if (style.anchor == Anchor::kMiddle) baseline.x -= 0.5 * width_px;
    if (style.anchor == Anchor::kEnd) baseline.x -= width_px;
    SelectFont(context_, style.size_px, style.bold);
    SetColor(style.color);
    cairo_move_to(context_, Bounded(baseline.x), Bounded(baseline.y));
    cairo_show_text(context_, Writable(utf8).c_str());
    cairo_new_path(context_);
  }

  void Picture(const PixelBox& box, const Image& image) override {
    if (image.pixels().empty() || !(box.width > 0.0) || !(box.height > 0.0)) return;
    const CairoSurface surface = ToCairo(image);
    cairo_save(context_);
    cairo_translate(context_, box.x, box.y);
    cairo_scale(context_, box.width / image.width(), box.height / image.height());
    cairo_set_source_surface(context_, surface.get(), 0.0, 0.0);
    cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_NEAREST);
    cairo_paint(context_);
    cairo_restore(context_);
  }

 private:
  void SetColor(Rgb color) {
    constexpr double kFull = 255.0;
    cairo_set_source_rgb(context_, color.red / kFull, color.green / kFull, color.blue / kFull);
  }

  cairo_t* context_;
};

cairo_status_t AppendTo(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

// Cairo names parts by numbers that go on from document to document; they become 1, 2, ... here.
// Pixels of pictures stay crisp.
std::string Settled(const std::string& svg) {
  static const std::regex kName(R"re((id="|#)(image|surface)(\d+))re");
  std::map<std::string, std::size_t> numbers;
  std::string settled;
  auto from = svg.cbegin();
  for (std::sregex_iterator name(svg.begin(), svg.end(), kName), end; name != end; ++name) {
    const std::size_t number =
        numbers.try_emplace((*name)[3].str(), numbers.size() + 1).first->second;
    settled.append(from, (*name)[0].first);
    if ((*name)[1] == "id=\"" && (*name)[2] == "image") {
      absl::StrAppend(&settled, "style=\"image-rendering:pixelated\" ");
    }
    absl::StrAppend(&settled, (*name)[1].str(), (*name)[2].str(), number);
    from = (*name)[0].second;
  }
  return settled.append(from, svg.cend());
}

}  // namespace

Image DrawImage(int width_px, int height_px, Rgb background, const Drawing& draw, double scale) {
  const CairoSurface surface(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(scale * width_px)),
      static_cast<int>(std::lround(scale * height_px))));
  {
    const CairoContext context(cairo_create(surface.get()));
    cairo_scale(context.get(), scale, scale);
    CairoCanvas canvas(context.get());
    canvas.FillBox({0.0, 0.0, static_cast<double>(width_px), static_cast<double>(height_px)},
                   background);
    draw(canvas);
  }
  return FromCairo(surface.get());
}

std::string DrawSvg(int width_px, int height_px, const Drawing& draw) {
  std::string svg;
  const CairoSurface surface(
      cairo_svg_surface_create_for_stream(AppendTo, &svg, width_px, height_px));
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  {
    const CairoContext context(cairo_create(surface.get()));
    CairoCanvas canvas(context.get());
    draw(canvas);
  }
  cairo_surface_finish(surface.get());
  return Settled(svg);
}

}  // namespace plumescout::lab
