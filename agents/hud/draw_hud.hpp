#pragma once

#include "agents/hud/hud_map.hpp"
#include "agents/hud/hud_picture.hpp"
#include "agents/hud/pen.hpp"

namespace lifeline::hud {

/// How the picture lies on the display: the own position below the middle of what the bands leave,
/// what is ahead above it.
class Projection {
 public:
  Projection(const HudPicture& picture, double bands_px, int width_px, int height_px);

  [[nodiscard]] Point to_pixel(const Eigen::Vector2d& p_map_m) const;
  /// Clockwise from upwards, of a heading in the map frame.
  [[nodiscard]] double turn_of(double heading_rad) const;
  [[nodiscard]] const Point& own() const { return own_; }
  [[nodiscard]] double pixels_per_m() const { return pixels_per_m_; }
  [[nodiscard]] const Pose2& T_map_head() const { return T_map_head_; }

 private:
  Pose2 T_map_head_;
  Point own_;
  double pixels_per_m_;
};

/// Where the map can be seen: inside of `area`, outside of the panels.
struct MapWindow {
  Rectangle area;
  std::vector<Rectangle> panels;

  [[nodiscard]] bool shows(const Point& p) const;
  /// Where a sign stands for what lies off the window: on the line towards it, at the window's
  /// edge.
  [[nodiscard]] Point edge_towards(const Point& from, const Point& p) const;
};

/// Draws all of a HUD's picture: the same pixels for a display, a file and a test.
void draw_hud(const HudPicture& picture, const HudMap& map, Pen& pen);

// Its parts, from below to above.
void draw_map(const HudPicture& picture, const HudMap& map, const Projection& projection, Pen& pen);
void draw_way(const HudPicture& picture, const Projection& projection, Pen& pen);
void draw_marks(const HudPicture& picture, const Projection& projection, const MapWindow& window,
                Pen& pen);
/// Draws the corners below `top`; what they cover.
std::vector<Rectangle> draw_panels(const HudPicture& picture, double top, Pen& pen);
/// How far down the bands reach, and the bands.
[[nodiscard]] double bands_height(const HudPicture& picture, double unit);
void draw_bands(const HudPicture& picture, Pen& pen);
/// Below `top`.
void draw_hold_bar(const HudPicture& picture, double top, Pen& pen);

}  // namespace lifeline::hud
