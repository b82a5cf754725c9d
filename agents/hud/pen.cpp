#include "agents/hud/pen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <cairo.h>

namespace lifeline::hud {
namespace {

constexpr double kRim = 0.28;  // of a unit, on either side

cairo_status_t append(void* text, const unsigned char* octets, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(octets), count);
  return CAIRO_STATUS_SUCCESS;
}

/// Clockwise from upwards, y down.
Point turned(const Point& p, double turn_rad) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

Outline placed(std::initializer_list<Point> points, const Point& centre, double scale,
               double turn_rad) {
  Outline outline;
  for (const Point& point : points) outline.push_back(centre + scale * turned(point, turn_rad));
  return outline;
}

}  // namespace

void Pen::Free::operator()(cairo_t* context) const {
  cairo_destroy(context);
}
void Pen::Free::operator()(cairo_surface_t* surface) const {
  cairo_surface_destroy(surface);
}

Pen::Pen(int width_px, int height_px)
    : width_(width_px),
      height_(height_px),
      unit_(std::min(height_px / 24.0, width_px / 40.0)),
      pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
              0xff000000U | kGround),
      surface_(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels_.data()),
                                                   CAIRO_FORMAT_RGB24, width_px, height_px,
                                                   4 * width_px)),
      context_(cairo_create(surface_.get())) {
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_antialias(context_.get(), CAIRO_ANTIALIAS_FAST);
  cairo_select_font_face(context_.get(), "B612", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
  // The same dots whatever the desktop prefers.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
}

Pen::~Pen() = default;

void Pen::use(Colour colour) {
  const auto part = [colour](unsigned shift) { return ((colour >> shift) & 0xffU) / 255.0; };
  cairo_set_source_rgb(context_.get(), part(16), part(8), part(0));
}

void Pen::trace(const Outline& outline, bool closed) {
  cairo_new_path(context_.get());
  for (const Point& point : outline) cairo_line_to(context_.get(), point.x(), point.y());
  if (closed) cairo_close_path(context_.get());
}

void Pen::fill(const Rectangle& rectangle, Colour colour) {
  use(colour);
  cairo_new_path(context_.get());
  // To whole pixels: sharp, and quickly filled.
  const double left = std::round(rectangle.x), top = std::round(rectangle.y);
  cairo_rectangle(context_.get(), left, top, std::round(rectangle.x + rectangle.width) - left,
                  std::round(rectangle.y + rectangle.height) - top);
  cairo_fill(context_.get());
}

void Pen::fill(const Outline& outline, Colour colour) {
  trace(outline, true);
  use(colour);
  cairo_fill(context_.get());
}

void Pen::sign(const Outline& outline, Colour colour) {
  trace(outline, true);
  use(kGround);
  cairo_set_line_width(context_.get(), 2.0 * kRim * unit_);
  cairo_stroke_preserve(context_.get());
  use(colour);
  cairo_fill(context_.get());
}

void Pen::frame(const Rectangle& rectangle, double thick, Colour colour) {
  use(colour);
  cairo_set_line_width(context_.get(), thick);
  cairo_new_path(context_.get());
  cairo_rectangle(context_.get(), rectangle.x + thick / 2.0, rectangle.y + thick / 2.0,
                  rectangle.width - thick, rectangle.height - thick);
  cairo_stroke(context_.get());
}

void Pen::line(const Outline& points, double thick, Colour colour, bool dashed) {
  trace(points, false);
  use(kGround);
  cairo_set_line_width(context_.get(), thick + 2.0 * kRim * unit_);
  cairo_stroke_preserve(context_.get());
  use(colour);
  cairo_set_line_width(context_.get(), thick);
  const double dashes[] = {2.0 * thick, 2.2 * thick};
  cairo_set_dash(context_.get(), dashes, dashed ? 2 : 0, 0.0);
  cairo_stroke(context_.get());
  cairo_set_dash(context_.get(), nullptr, 0, 0.0);
}

void Pen::ring(const Point& centre, double radius, double thick, Colour colour) {
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x(), centre.y(), radius, 0.0, 2.0 * std::numbers::pi);
  use(kGround);
  cairo_set_line_width(context_.get(), thick + 2.0 * kRim * unit_);
  cairo_stroke_preserve(context_.get());
  use(colour);
  cairo_set_line_width(context_.get(), thick);
  cairo_stroke(context_.get());
}

void Pen::text(const Point& at, const std::string& text, const TextStyle& style) {
  double x = at.x();
  if (style.align != Align::left || style.boxed) {
    const double wide = text_width(text, style.size);
    if (style.align != Align::left) x -= style.align == Align::right ? wide : wide / 2.0;
    const double rim = 0.25 * style.size;
    if (style.boxed)
      fill(Rectangle{x - rim, at.y() - style.size, wide + 2.0 * rim, style.size + rim}, kGround);
  }
  cairo_set_font_size(context_.get(), style.size);
  cairo_move_to(context_.get(), x, at.y());
  use(style.colour);
  cairo_show_text(context_.get(), text.c_str());
  cairo_new_path(context_.get());
}

double Pen::text_width(const std::string& text, double size) {
  cairo_set_font_size(context_.get(), size);
  cairo_text_extents_t extents{};
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

std::string Pen::fitted(std::string text, double width, double size) {
  if (text_width(text, size) <= width) return text;
  while (!text.empty() && text_width(text + "..", size) > width) text.pop_back();
  return text.empty() ? text : text + "..";
}

std::span<std::uint32_t> Pen::pixels() {
  cairo_surface_flush(surface_.get());
  return pixels_;
}

void Pen::pixels_changed() {
  cairo_surface_mark_dirty(surface_.get());
}

Result<std::string> Pen::png() {
  std::string content;
  cairo_status_t status = cairo_status(context_.get());
  if (status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_write_to_png_stream(surface_.get(), append, &content);
  if (status != CAIRO_STATUS_SUCCESS) {
    return fail(ErrorCode::unavailable, "the HUD cannot be drawn ({})",
                cairo_status_to_string(status));
  }
  return content;
}

Outline regular(const Point& centre, double radius, int sides) {
  const int corners = sides == 0 ? 28 : sides;
  const double first = std::numbers::pi / 2.0 + std::numbers::pi / corners;
  const double grown = sides == 0 ? radius : radius * (sides == 3 ? 1.45 : 1.15);
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = first + 2.0 * std::numbers::pi * i / corners;
    outline.push_back(centre + grown * Point(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

Outline arrow(const Point& centre, double length, double turn_rad) {
  return placed({{0.0, -0.5},
                 {0.42, 0.0},
                 {0.16, 0.0},
                 {0.16, 0.5},
                 {-0.16, 0.5},
                 {-0.16, 0.0},
                 {-0.42, 0.0}},
                centre, length, turn_rad);
}

Outline chevron(const Point& centre, double length, double turn_rad) {
  return placed({{0.0, -0.55}, {0.42, 0.45}, {0.0, 0.22}, {-0.42, 0.45}}, centre, length, turn_rad);
}

}  // namespace lifeline::hud
