#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "agents/hud/style.hpp"
#include "common/base/result.hpp"

typedef struct _cairo cairo_t;
typedef struct _cairo_surface cairo_surface_t;

namespace lifeline::hud {

/// In pixels from the upper left corner, y down.
using Point = Eigen::Vector2d;
using Outline = std::vector<Point>;

struct Rectangle {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  [[nodiscard]] bool contains(const Point& p) const {
    return p.x() >= x && p.y() >= y && p.x() <= x + width && p.y() <= y + height;
  }
};

enum class Align { left, centre, right };

/// A picture in memory and what draws on it. One owner, not thread-safe.
class Pen {
 public:
  Pen(int width_px, int height_px);
  ~Pen();
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// A 24th of the height (or a 40th of the width, if that is less): sizes are given in it.
  [[nodiscard]] double unit() const { return unit_; }

  void fill(const Rectangle& rectangle, Colour colour);
  void fill(const Outline& outline, Colour colour);
  /// With a dark rim, so that it stands out from whatever lies below.
  void sign(const Outline& outline, Colour colour);
  void frame(const Rectangle& rectangle, double thick, Colour colour);
  /// An open line; with a dark rim; of dashes, if told.
  void line(const Outline& points, double thick, Colour colour, bool dashed);
  void ring(const Point& centre, double radius, double thick, Colour colour);

  struct TextStyle {
    double size = 16.0;
    Colour colour = kInk;
    Align align = Align::left;
    bool boxed = false;  ///< on a dark box, for text on the map
  };
  /// `at`: on the base line. Bold; ASCII.
  void text(const Point& at, const std::string& text, const TextStyle& style);
  [[nodiscard]] double text_width(const std::string& text, double size);
  /// The text without what is too wide of it.
  [[nodiscard]] std::string fitted(std::string text, double width, double size);

  /// All pixels, row by row, 0xffRRGGBB; valid until the next stroke.
  [[nodiscard]] std::span<std::uint32_t> pixels();
  /// After pixels() were written to.
  void pixels_changed();
  /// A PNG file's content.
  [[nodiscard]] Result<std::string> png();

 private:
  void use(Colour colour);
  void trace(const Outline& outline, bool closed);

  struct Free {
    void operator()(cairo_t* context) const;
    void operator()(cairo_surface_t* surface) const;
  };
  int width_, height_;
  double unit_;
  std::vector<std::uint32_t> pixels_;
  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

/// A regular outline of `sides` (0: a circle), standing on a side.
[[nodiscard]] Outline regular(const Point& centre, double radius, int sides);
/// An arrow of this length that points `turn_rad` clockwise from upwards.
[[nodiscard]] Outline arrow(const Point& centre, double length, double turn_rad);
/// What one stands for on the map: a slim triangle, notched behind.
[[nodiscard]] Outline chevron(const Point& centre, double length, double turn_rad);

}  // namespace lifeline::hud
