#include "common/files/canvas.hpp"

#include <cmath>
#include <numbers>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include "common/base/check.hpp"

namespace lifeline::files {
namespace {

cairo_status_t append(void* text, const unsigned char* octets, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(octets), count);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_surface(DrawingFormat format, int width, int height, std::string* content) {
  switch (format) {
    case DrawingFormat::svg:
      return cairo_svg_surface_create_for_stream(append, content, width, height);
    case DrawingFormat::pdf:
      return cairo_pdf_surface_create_for_stream(append, content, width, height);
    case DrawingFormat::png:
      break;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
}

}  // namespace

void Canvas::Free::operator()(cairo_t* context) const {
  cairo_destroy(context);
}
void Canvas::Free::operator()(cairo_surface_t* surface) const {
  cairo_surface_destroy(surface);
}

Canvas::Canvas(int width_px, int height_px, Colour ground, DrawingFormat format)
    : format_(format),
      ground_(ground),
      width_(width_px),
      height_(height_px),
      surface_(make_surface(format, width_px, height_px, &content_)),
      context_(cairo_create(surface_.get())) {
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  fill_rectangle(0.0, 0.0, width_px, height_px, ground);
}

Canvas::~Canvas() = default;

void Canvas::enter(double x, double y, double width, double height) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), x, y, width, height);
  cairo_clip(context_.get());
  cairo_translate(context_.get(), x, y);
}

void Canvas::enter_scaled(double x, double y, double width, double height, double times) {
  enter(x, y, width, height);
  cairo_scale(context_.get(), times, times);
}

void Canvas::new_page() {
  cairo_show_page(context_.get());
  fill_rectangle(0.0, 0.0, width_, height_, ground_);
}

void Canvas::leave() {
  cairo_restore(context_.get());
}

void Canvas::use(Colour colour, double opacity) {
  const auto part = [colour](unsigned shift) { return ((colour >> shift) & 0xffU) / 255.0; };
  cairo_set_source_rgba(context_.get(), part(16), part(8), part(0), opacity);
}

void Canvas::use(const TextStyle& style) {
  cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), style.size_px);
}

void Canvas::fill_rectangle(double x, double y, double width, double height, Colour colour) {
  use(colour);
  cairo_rectangle(context_.get(), x, y, width, height);
  cairo_fill(context_.get());
}

void Canvas::hatch(double width, double height, double spacing, Colour colour) {
  use(colour);
  cairo_set_line_width(context_.get(), spacing / 8.0);
  for (double x = -height; x < width; x += spacing) {
    cairo_move_to(context_.get(), x, height);
    cairo_line_to(context_.get(), x + height, 0.0);
  }
  cairo_stroke(context_.get());
}

void Canvas::line(const std::vector<Eigen::Vector2d>& points, double width, Colour colour,
                  bool dashed, double opacity) {
  use(colour, opacity);
  cairo_set_line_width(context_.get(), width);
  const double dashes[] = {3.0 * width, 2.0 * width};
  cairo_set_dash(context_.get(), dashes, dashed ? 2 : 0, 0.0);
  cairo_new_path(context_.get());  // without a line from where the last text ended
  for (const auto& point : points) cairo_line_to(context_.get(), point.x(), point.y());
  cairo_stroke(context_.get());
  cairo_set_dash(context_.get(), nullptr, 0, 0.0);
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius, Colour fill, Colour rim) {
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x(), centre.y(), radius, 0.0, 2.0 * std::numbers::pi);
  use(fill);
  cairo_fill_preserve(context_.get());
  use(rim);
  cairo_set_line_width(context_.get(), radius / 2.5);
  cairo_stroke(context_.get());
}

void Canvas::text(double x, double y, const std::string& text, const TextStyle& style) {
  use(style);
  cairo_move_to(context_.get(), x, y);
  if (style.halo) {
    cairo_text_path(context_.get(), text.c_str());
    use(0xffffff, 0.9);
    cairo_set_line_width(context_.get(), style.size_px / 3.5);
    cairo_stroke_preserve(context_.get());
    use(style.colour);
    cairo_fill(context_.get());
    return;
  }
  use(style.colour);
  cairo_show_text(context_.get(), text.c_str());
}

double Canvas::text_width(const std::string& text, const TextStyle& style) {
  use(style);
  cairo_text_extents_t extents{};
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

std::string Canvas::fitted(const std::string& text, double width, const TextStyle& style) {
  if (text_width(text, style) <= width) return text;
  std::string part = text;
  const auto is_inside_of_a_character = [](char c) { return (c & '\xc0') == '\x80'; };
  while (!part.empty() && text_width(part + "…", style) > width) {
    while (is_inside_of_a_character(part.back()) && part.size() > 1) part.pop_back();
    part.pop_back();
  }
  return part + "…";
}

void Canvas::pixels(double x, double y, int width, int height,
                    const std::vector<std::optional<Colour>>& colours) {
  const std::unique_ptr<cairo_surface_t, Free> image(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
  LIFELINE_CHECK(colours.size() ==
                 static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (cairo_surface_status(image.get()) != CAIRO_STATUS_SUCCESS) return;  // finish() tells it
  cairo_surface_flush(image.get());
  unsigned char* const data = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  for (int row = 0; row < height; ++row) {
    auto* const line = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t{row} * stride);
    for (int column = 0; column < width; ++column) {
      const auto& colour = colours[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(column)];
      line[column] = colour ? 0xff000000U | *colour : 0U;
    }
  }
  cairo_surface_mark_dirty(image.get());
  cairo_set_source_surface(context_.get(), image.get(), x, y);
  // Enlarged, a cell stays a square.
  if (format_ != DrawingFormat::png)
    cairo_pattern_set_filter(cairo_get_source(context_.get()), CAIRO_FILTER_NEAREST);
  cairo_paint(context_.get());
}

Result<std::string> Canvas::finish() {
  cairo_status_t status = cairo_status(context_.get());
  if (status == CAIRO_STATUS_SUCCESS && format_ == DrawingFormat::png) {
    status = cairo_surface_write_to_png_stream(surface_.get(), append, &content_);
  } else if (status == CAIRO_STATUS_SUCCESS) {
    cairo_surface_finish(surface_.get());
    status = cairo_surface_status(surface_.get());
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    return fail(ErrorCode::unavailable, "the picture cannot be drawn ({})",
                cairo_status_to_string(status));
  }
  return std::move(content_);
}

}  // namespace lifeline::files
