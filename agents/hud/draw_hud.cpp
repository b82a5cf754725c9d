#include "agents/hud/draw_hud.hpp"

namespace lifeline::hud {
namespace {

constexpr double kOwnDown = 0.62;  // of the height: what is ahead matters more

/// Below the bands, so far from the edges that a sign and its words fit.
MapWindow make_window(double bands_px, const std::vector<Rectangle>& panels, const Pen& pen) {
  const double u = pen.unit(), margin = 2.7 * u;
  MapWindow window{{margin, bands_px + margin, pen.width() - 2.0 * margin,
                    pen.height() - bands_px - 2.0 * margin},
                   {}};
  for (const Rectangle& panel : panels) {
    window.panels.push_back({panel.x - margin, panel.y - margin, panel.width + 2.0 * margin,
                             panel.height + 2.0 * margin});
  }
  return window;
}

}  // namespace

Projection::Projection(const HudPicture& picture, double bands_px, int width_px, int height_px)
    : T_map_head_(picture.T_map_head),
      own_(width_px / 2.0, bands_px + kOwnDown * (height_px - bands_px)),
      pixels_per_m_(kOwnDown * height_px / picture.metres_ahead) {}

Point Projection::to_pixel(const Eigen::Vector2d& p_map_m) const {
  const Eigen::Vector2d p_head = T_map_head_.inverse() * p_map_m;
  return own_ + pixels_per_m_ * Point(-p_head.y(), -p_head.x());
}

double Projection::turn_of(double heading_rad) const {
  return T_map_head_.yaw_rad - heading_rad;
}

void draw_hud(const HudPicture& picture, const HudMap& map, Pen& pen) {
  const double bands_px = bands_height(picture, pen.unit());
  const Projection projection(picture, bands_px, pen.width(), pen.height());
  draw_map(picture, map, projection, pen);
  draw_way(picture, projection, pen);
  draw_bands(picture, pen);
  const auto panels = draw_panels(picture, bands_px, pen);
  draw_marks(picture, projection, make_window(bands_px, panels, pen), pen);
  draw_hold_bar(picture, bands_px, pen);
}

}  // namespace lifeline::hud
