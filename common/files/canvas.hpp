#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/base/result.hpp"

typedef struct _cairo cairo_t;
typedef struct _cairo_surface cairo_surface_t;

namespace lifeline::files {

/// 0xRRGGBB
using Colour = std::uint32_t;

/// What a drawing becomes: dots, or lines and letters that can be enlarged.
enum class DrawingFormat { png, svg, pdf };

/// A picture to draw on, in pixels (of a PDF: points of 1/72 inch) from the upper left corner, y
/// down. Fonts are DejaVu Sans.
class Canvas {
 public:
  Canvas(int width_px, int height_px, Colour ground, DrawingFormat format = DrawingFormat::png);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Everything drawn from here on appears only within this rectangle, moved by its corner, until
  /// leave().
  void enter(double x, double y, double width, double height);
  void leave();
  /// The same within a part of the canvas on which `times` of its own units make one drawn here.
  void enter_scaled(double x, double y, double width, double height, double times);
  /// Ends a page of a PDF; what follows stands on the next one.
  void new_page();

  void fill_rectangle(double x, double y, double width, double height, Colour colour);
  /// Parallel lines across a rectangle, from lower left to upper right.
  void hatch(double width, double height, double spacing, Colour colour);
  void line(const std::vector<Eigen::Vector2d>& points, double width, Colour colour,
            bool dashed = false, double opacity = 1.0);
  void disc(const Eigen::Vector2d& centre, double radius, Colour fill, Colour rim);

  struct TextStyle {
    double size_px = 14.0;
    bool bold = false;
    Colour colour = 0;
    bool halo = false;  ///< with a white rim, to be read on anything
  };
  /// Writes from the left end of the base line.
  void text(double x, double y, const std::string& text, const TextStyle& style);
  [[nodiscard]] double text_width(const std::string& text, const TextStyle& style);
  /// The text, with its end cut off and an ellipsis where it would be wider.
  [[nodiscard]] std::string fitted(const std::string& text, double width, const TextStyle& style);

  /// Sets single pixels, row by row from above, the first one at (x, y). Those that are empty stay.
  void pixels(double x, double y, int width, int height,
              const std::vector<std::optional<Colour>>& colours);

  /// The whole drawing as a file's content. Once: nothing can be drawn afterwards.
  [[nodiscard]] Result<std::string> finish();

 private:
  void use(Colour colour, double opacity = 1.0);
  void use(const TextStyle& style);

  DrawingFormat format_;
  Colour ground_;
  int width_, height_;
  std::string content_;  ///< of a drawing in lines, as it is made
  struct Free {
    void operator()(cairo_t* context) const;
    void operator()(cairo_surface_t* surface) const;
  };
  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

}  // namespace lifeline::files
