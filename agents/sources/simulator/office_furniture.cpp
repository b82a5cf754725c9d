#include "agents/sources/simulator/office_furniture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "agents/sources/simulator/office_layout.hpp"

namespace lifeline::sources {
namespace {

constexpr double kPassageM = 0.9;

Box grown(const Box& box, double by_m) {
  const Eigen::Vector2d margin(by_m, by_m);
  return Box(box.min() - margin, box.max() + margin);
}

class Furnisher {
 public:
  Furnisher(const OfficeLayout& layout, Draw& draw) : layout_(layout), draw_(draw) {
    for (const Box& opening : layout.openings) taken_.push_back(grown(opening, kPassageM));
  }

  OfficeFurniture furnish() {
    for (const Box& room : layout_.rooms) {
      const double area_m2 = room.sizes().prod();
      const int cupboards = static_cast<int>(area_m2 / 8.0 * draw_.between(0.6, 1.6)) + 1;
      for (int i = 0; i < cupboards; ++i) try_piece([&] { return cupboard(room); });
      const int standing = static_cast<int>(area_m2 / 16.0 * draw_.between(0.4, 1.4));
      for (int i = 0; i < standing; ++i) add_standing(room);
    }
    for (const Box& corridor : layout_.corridors) {
      const int ribs = static_cast<int>(corridor.sizes().maxCoeff() / 4.0);
      for (int i = 0; i < ribs; ++i) add_rib(corridor);
    }
    return std::move(furniture_);
  }

 private:
  [[nodiscard]] bool is_clear(const Box& piece) const {
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](const Box& other) { return other.intersects(piece); });
  }

  void take(const Box& piece) { taken_.push_back(grown(piece, kPassageM)); }

  /// Draws places until one is clear, a few times.
  template <typename Place>
  void try_piece(Place place) {
    for (int attempt = 0; attempt < 6; ++attempt) {
      const Box piece = place();
      if (!is_clear(piece)) continue;
      take(piece);
      furniture_.boxes.push_back(piece);
      return;
    }
  }

  /// A box of `length_m` along one of the walls of `room`, reaching `depth_m` into it.
  Box against_wall(const Box& room, int side, double length_m, double depth_m) {
    const int along = side % 2;  // 0: lower or upper wall, 1: left or right wall
    const int across = 1 - along;
    const double length = to_centimetres(std::min(length_m, room.sizes()[along]));
    Eigen::Vector2d low, high;
    low[along] = to_centimetres(draw_.between(room.min()[along], room.max()[along] - length));
    // Too narrow a gap to a corner is closed.
    if (low[along] - room.min()[along] < 0.3) low[along] = room.min()[along];
    high[along] = low[along] + length;
    if (room.max()[along] - high[along] < 0.3) high[along] = room.max()[along];
    const bool at_low = side < 2;
    low[across] = at_low ? room.min()[across] : to_centimetres(room.max()[across] - depth_m);
    high[across] = at_low ? to_centimetres(room.min()[across] + depth_m) : room.max()[across];
    return Box(low, high);
  }

  Box cupboard(const Box& room) {
    return against_wall(room, draw_.below(4), draw_.between(0.7, 2.0), draw_.between(0.35, 0.6));
  }

  /// A pillar that stands out of a corridor's wall a little; not where another corridor meets it.
  void add_rib(const Box& corridor) {
    const bool along_x = corridor.sizes().x() > corridor.sizes().y();
    const int side = (along_x ? 0 : 1) + 2 * draw_.below(2);
    const Box rib = against_wall(corridor, side, draw_.between(0.3, 0.6), draw_.between(0.1, 0.22));
    const bool at_mouth =
        std::any_of(layout_.corridors.begin(), layout_.corridors.end(), [&](const Box& other) {
          return &other != &corridor && grown(other, kPassageM).intersects(rib);
        });
    if (at_mouth || !is_clear(rib)) return;
    take(rib);
    furniture_.boxes.push_back(rib);
  }

  void add_standing(const Box& room) {
    const bool pillar = draw_.chance(0.4);
    const double half_length = pillar ? draw_.between(0.2, 0.3) : draw_.between(0.5, 1.1);
    const double half_depth = pillar ? half_length : draw_.between(0.2, 0.3);
    const int corners = pillar && draw_.chance(0.6) ? 12 : 4;
    const double turn = corners == 12 ? 0.0 : draw_.between(-0.6, 0.6);
    const double reach = corners == 12 ? half_length : std::hypot(half_length, half_depth);
    const Box inner = grown(room, -(kPassageM + reach));
    if (inner.isEmpty()) return;
    const Eigen::Vector2d centre(draw_.between(inner.min().x(), inner.max().x()),
                                 draw_.between(inner.min().y(), inner.max().y()));
    const Box piece = grown(Box(centre, centre), reach);
    if (!is_clear(piece)) return;
    take(piece);
    add_loop(centre, {half_length, half_depth}, turn, corners);
  }

  /// A box (four corners) or something round, run round clockwise.
  void add_loop(const Eigen::Vector2d& centre, const Eigen::Vector2d& half, double turn,
                int corners) {
    const double c = std::cos(turn), s = std::sin(turn);
    const auto corner = [&](int i) -> Eigen::Vector2d {
      const double angle = -2.0 * std::numbers::pi * (i % corners + 0.5) / corners;
      const double stretch = corners == 4 ? std::numbers::sqrt2 : 1.0;
      const double x = half.x() * stretch * std::cos(angle),
                   y = half.y() * stretch * std::sin(angle);
      return centre + Eigen::Vector2d(c * x - s * y, s * x + c * y);
    };
    for (int i = 0; i < corners; ++i) furniture_.loops.push_back({corner(i), corner(i + 1)});
  }

  const OfficeLayout& layout_;
  Draw& draw_;
  std::vector<Box> taken_;  // with the passage round each piece and each doorway
  OfficeFurniture furniture_;
};

}  // namespace

OfficeFurniture furnish_office(const OfficeLayout& layout, Draw& draw) {
  return Furnisher(layout, draw).furnish();
}

}  // namespace lifeline::sources
