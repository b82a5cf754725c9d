// Who and what is where: on the map, or at its edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "agents/hud/draw_hud.hpp"

namespace lifeline::hud {
namespace {

constexpr std::size_t kMostFindsAtEdge = 2;
constexpr std::array<int, sharing::kMarkShapes> kSides{0, 4, 3, 5, 6};

std::string metres(const std::optional<double>& distance_m) {
  return distance_m ? fmt::format("{:.0f} m", *distance_m) : "";
}

/// Clockwise from upwards, of a direction on the display.
double turn_towards(const Point& from, const Point& to) {
  return std::atan2(to.x() - from.x(), from.y() - to.y());
}

/// Words below a sign, or, where they would leave the window below, above it.
void write_at(const Point& centre, const std::string& words, Colour colour, const MapWindow& window,
              Pen& pen) {
  const double u = pen.unit(), size = 1.5 * u;
  const double half = pen.text_width(words, size) / 2.0;
  Point at(std::clamp(centre.x(), half + 0.4 * u, std::max(half, pen.width() - half - 0.4 * u)),
           centre.y() + 2.9 * u);
  if (at.y() > window.area.y + window.area.height + 0.6 * u) at.y() = centre.y() - 1.9 * u;
  pen.text(at, words, {size, colour, Align::centre, true});
}

/// Where a sign stands: at its place, or at the window's edge on the way there.
struct Stand {
  Point place, centre;
  bool inside;
};

Stand stand_of(const Eigen::Vector2d& p_map_m, const Projection& projection,
               const MapWindow& window) {
  const Point place = projection.to_pixel(p_map_m);
  const bool inside = window.shows(place);
  return {place, inside ? place : window.edge_towards(projection.own(), place), inside};
}

/// A small triangle beside a sign at the edge, pointing to what lies beyond.
void point_beyond(const Point& centre, double turn_rad, Colour colour, Pen& pen) {
  const double u = pen.unit();
  const Point out(std::sin(turn_rad), -std::cos(turn_rad)), side(-out.y(), out.x());
  const Point tip = centre + 2.5 * u * out, foot = centre + 1.5 * u * out;
  pen.sign({tip, foot + 0.9 * u * side, foot - 0.9 * u * side}, colour);
}

void draw_mate(const HudMate& mate, const Projection& projection, const MapWindow& window,
               Pen& pen) {
  const double u = pen.unit();
  const auto [place, centre, inside] = stand_of(mate.p_map_m, projection, window);
  const Colour colour = mate.stale ? kFaint : kMate;
  if (mate.calls_for_help) pen.ring(centre, 2.1 * u, 0.5 * u, kMayday);
  if (!inside) {
    point_beyond(centre, turn_towards(projection.own(), place), colour, pen);
  } else if (mate.heading_rad && !mate.stale) {
    point_beyond(centre, projection.turn_of(*mate.heading_rad), colour, pen);
  }
  const int sides = kSides[mate.mark.shape];
  pen.sign(regular(centre, 1.4 * u, sides), colour);
  if (mate.stale) pen.fill(regular(centre, 1.1 * u, sides), kGround);  // hollow
  const std::string label = mate.heading_rad ? mate.mark.label : "?";
  const double lower = sides == 3 ? 0.75 * u : 0.5 * u;
  pen.text(centre + Point(0.0, lower), label,
           {1.4 * u, mate.stale ? kFaint : kGround, Align::centre});
  std::string words = inside ? "" : metres(mate.distance_m);
  if (mate.stale) words += fmt::format("{}{:.0f} s old", words.empty() ? "" : "  ", mate.age_s);
  if (!words.empty()) write_at(centre, words, mate.stale ? kFaint : kInk, window, pen);
}

void draw_find(const HudFind& find, const Projection& projection, const MapWindow& window,
               Pen& pen) {
  const double u = pen.unit();
  const auto [place, centre, inside] = stand_of(find.p_map_m, projection, window);
  if (!inside) point_beyond(centre, turn_towards(projection.own(), place), kFind, pen);
  if (find.is_tag) {
    pen.sign(regular(centre, 1.2 * u, 4), kFind);
  } else {  // a cross
    const double r = 1.4 * u, a = 0.5 * u;
    const Outline cross{{-a, -r}, {a, -r}, {a, -a}, {r, -a}, {r, a},   {a, a},
                        {a, r},   {-a, r}, {-a, a}, {-r, a}, {-r, -a}, {-a, -a}};
    Outline outline;
    for (const Point& point : cross) outline.push_back(centre + point);
    pen.sign(outline, kFind);
  }
  // Nobody else has confirmed it.
  if (!find.confirmed)
    pen.text(centre + Point(0.0, 0.5 * u), "?", {1.4 * u, kGround, Align::centre});
  write_at(centre, metres(find.distance_m), kFind, window, pen);
}

/// A magnifying glass: thin beside all else, since it is only a suggestion.
void draw_search(const HudSearch& search, const Projection& projection, const MapWindow& window,
                 Pen& pen) {
  const double u = pen.unit();
  const auto [place, centre, inside] = stand_of(search.p_map_m, projection, window);
  if (!inside) point_beyond(centre, turn_towards(projection.own(), place), kInk, pen);
  const Point lens = centre - Point(0.25, 0.25) * u, out = Point(1.0, 1.0).normalized(),
              side = Point(-out.y(), out.x()) * (0.25 * u);
  const Point begin = lens + 0.9 * u * out, end = lens + 2.0 * u * out;
  pen.sign({begin + side, end + side, end - side, begin - side}, kInk);
  pen.ring(lens, 0.9 * u, 0.4 * u, kInk);
  write_at(centre, fmt::format("SEARCH {:.0f} m", search.distance_m), kInk, window, pen);
}

void draw_own(const HudPicture& picture, const Projection& projection, Pen& pen) {
  const double u = pen.unit();
  if (picture.heading_known) {
    pen.sign(chevron(projection.own(), 3.0 * u, 0.0), kInk);
    return;
  }
  pen.sign(regular(projection.own(), 1.5 * u, 0), kInk);
  pen.text(projection.own() + Point(0.0, 0.75 * u), "?", {2.2 * u, kGround, Align::centre});
}

}  // namespace

bool MapWindow::shows(const Point& p) const {
  return area.contains(p) &&
         std::ranges::none_of(panels, [&](const Rectangle& panel) { return panel.contains(p); });
}

Point MapWindow::edge_towards(const Point& from, const Point& p) const {
  const Point way = p - from;
  const double length = way.norm();
  Point last = from;
  for (double gone = 0.0; gone < length; gone += 2.0) {
    const Point here = from + way * (gone / length);
    if (!shows(here)) break;
    last = here;
  }
  return last;
}

void draw_marks(const HudPicture& picture, const Projection& projection, const MapWindow& window,
                Pen& pen) {
  // All else lies on top of it.
  if (picture.search) draw_search(*picture.search, projection, window, pen);
  auto finds = picture.finds;
  std::ranges::sort(finds, {}, &HudFind::distance_m);
  // Of those beyond the edge, the nearest.
  std::size_t at_edge = 0;
  for (const HudFind& find : finds) {
    const bool inside = window.shows(projection.to_pixel(find.p_map_m));
    if (inside || ++at_edge <= kMostFindsAtEdge) draw_find(find, projection, window, pen);
  }
  auto mates = picture.mates;
  // Who calls for help lies on top of all others.
  std::ranges::stable_sort(
      mates, {}, [](const HudMate& mate) { return std::pair(mate.calls_for_help, !mate.stale); });
  for (const HudMate& mate : mates) draw_mate(mate, projection, window, pen);
  draw_own(picture, projection, pen);
}

}  // namespace lifeline::hud
