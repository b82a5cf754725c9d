#include "agents/sources/simulator/office_layout.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace lifeline::sources {
namespace {

constexpr double kLeastRoomM = 2.6;
constexpr double kCrossCorridorM = 1.5;
constexpr double kDeepRoomM = 6.4;  ///< from here on a room may be split into front and back

struct Span {
  double low;
  double high;
  [[nodiscard]] double length() const { return high - low; }
};

Box box_of(Span x, Span y) {
  return Box(Eigen::Vector2d(x.low, y.low), Eigen::Vector2d(x.high, y.high));
}

/// One stretch of the building along x, with the corridors' places in it.
struct Section {
  Span x;
  std::vector<Span> corridors;  ///< in y, from below
};

/// A row of rooms between two corridors or between a corridor and the outer wall.
struct Band {
  Span x;
  Span y;
  bool corridor_below;
  bool corridor_above;
};

class OfficePlanner {
 public:
  OfficePlanner(double width_m, double depth_m, Draw& draw)
      : x_{kOuterWallM, width_m - kOuterWallM},
        y_{kOuterWallM, depth_m - kOuterWallM},
        draw_(draw) {
    constexpr double kThicknesses[] = {0.10, 0.12, 0.15};
    wall_m_ = kThicknesses[draw_.below(3)];
  }

  OfficeLayout plan() {
    make_sections();
    const std::size_t bands = sections_.front().corridors.size() + 1;
    const std::size_t exit_section = draw_below(sections_.size());
    const std::size_t exit_band = draw_.chance(0.5) ? 0 : bands - 1;
    hall_section_ = draw_below(sections_.size());
    left_out_ =
        draw_.chance(0.6) ? (draw_.chance(0.5) ? 0 : sections_.size() - 1) : sections_.size();
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      for (const Span& corridor : sections_[s].corridors) {
        layout_.corridors.push_back(box_of(sections_[s].x, corridor));
      }
      for (std::size_t b = 0; b < bands; ++b) {
        const bool between = b > 0 && b + 1 < bands;
        const bool crossed =
            between ? s == 0 || s + 1 == sections_.size() : s == exit_section && b == exit_band;
        fill_band(s, b, crossed);
      }
    }
    return std::move(layout_);
  }

 private:
  std::size_t draw_below(std::size_t count) {
    return static_cast<std::size_t>(draw_.below(static_cast<int>(count)));
  }

  /// Cuts `whole` into `count` parts that differ by up to +-spread of the mean.
  std::vector<Span> cut(Span whole, std::size_t count, double spread) {
    std::vector<double> shares;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      shares.push_back(draw_.between(1.0 - spread, 1.0 + spread));
      sum += shares.back();
    }
    std::vector<Span> parts;
    double low = whole.low, share = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      share += shares[i];
      const double high =
          i + 1 == count ? whole.high : to_centimetres(whole.low + whole.length() * share / sum);
      parts.push_back({low, high});
      low = high;
    }
    return parts;
  }

  void make_sections() {
    const auto corridor_count = static_cast<std::size_t>(std::max(1.0, (y_.length() + 4.0) / 12.0));
    const auto section_count =
        static_cast<std::size_t>(std::max(1.0, std::round(x_.length() / 11.0)));
    const std::vector<Span> bands = cut(y_, corridor_count + 1, 0.14);
    std::vector<double> widths;
    for (std::size_t i = 0; i < corridor_count; ++i) {
      widths.push_back(to_centimetres(draw_.between(1.6, 2.2)));
    }
    double jog = draw_.chance(0.5) ? 1.0 : -1.0;
    for (const Span& x : cut(x_, section_count, 0.15)) {
      Section section{x, {}};
      const double shift = to_centimetres(jog * draw_.between(0.10, 0.35));
      for (std::size_t i = 0; i < corridor_count; ++i) {
        const double low = to_centimetres(bands[i].high - 0.5 * widths[i] + shift);
        section.corridors.push_back({low, low + widths[i]});
      }
      sections_.push_back(std::move(section));
      jog = -jog;
    }
  }

  void fill_band(std::size_t s, std::size_t b, bool crossed) {
    const Section& section = sections_[s];
    const bool first = s == 0, last = s + 1 == sections_.size();
    // A wall towards the next section on both sides of its border: the corridors jog there.
    Band band{{section.x.low + (first ? 0.0 : wall_m_), section.x.high - (last ? 0.0 : wall_m_)},
              y_,
              b > 0,
              b < section.corridors.size()};
    if (band.corridor_below) band.y.low = section.corridors[b - 1].high + kCorridorWallM;
    if (band.corridor_above) band.y.high = section.corridors[b].low - kCorridorWallM;
    hall_wanted_ = s == hall_section_ && !(band.corridor_below && band.corridor_above);
    const bool at_corner = s == left_out_ && !(band.corridor_below && band.corridor_above);
    const double least = 2.0 * (kLeastRoomM + wall_m_) + kCrossCorridorM;
    if (crossed && band.x.length() >= least) {
      const double low = to_centimetres(draw_.between(band.x.low + kLeastRoomM + wall_m_,
                                                      band.x.high - least + kLeastRoomM + wall_m_));
      const Span cross{low, to_centimetres(low + kCrossCorridorM)};
      layout_.corridors.push_back(
          box_of(cross, {band.y.low - (band.corridor_below ? kCorridorWallM : 0.0),
                         band.y.high + (band.corridor_above ? kCorridorWallM : 0.0)}));
      Band left = band, right = band;
      left.x.high = cross.low - wall_m_;
      right.x.low = cross.high + wall_m_;
      fill_row(left, at_corner && first, false);
      fill_row(right, false, at_corner && last && !first);
    } else {
      fill_row(band, at_corner && first, at_corner && last && !first);
    }
  }

  double draw_room_width() {
    const double kind = draw_.uniform();
    if (kind < 0.45) return draw_.between(kLeastRoomM, 3.6);
    return kind < 0.8 ? draw_.between(3.6, 5.0) : draw_.between(5.0, 7.5);
  }

  /// Puts rooms side by side; at one end of the row the building's corner may be left out.
  void fill_row(const Band& band, bool leave_out_first, bool leave_out_last) {
    std::vector<Box> neighbours;  // of the room before, at their common wall
    for (double low = band.x.low; low < band.x.high;) {
      double high = to_centimetres(low + draw_room_width());
      if (band.x.high - high < kLeastRoomM + wall_m_) high = band.x.high;
      const bool whole_row = low == band.x.low && high == band.x.high;
      const bool left_out =
          !whole_row && high - low <= 5.5 && left_out_ < sections_.size() &&
          ((leave_out_first && low == band.x.low) || (leave_out_last && high == band.x.high));
      if (left_out) {
        left_out_ = sections_.size();  // one corner is enough
        neighbours.clear();
      } else {
        const std::vector<Box> rooms = add_rooms({low, high}, band);
        for (const Box& left : neighbours) {
          for (const Box& right : rooms) connect_side_by_side(left, right);
        }
        neighbours = rooms;
      }
      low = high + wall_m_;
    }
  }

  /// A room with its door to the corridor, or a front room with a back room behind it.
  std::vector<Box> add_rooms(Span x, const Band& band) {
    std::vector<Box> rooms;
    const bool both = band.corridor_below && band.corridor_above;
    if (!both && band.y.length() > kDeepRoomM && draw_.chance(0.5)) {
      const double depth = band.y.length() * draw_.between(0.43, 0.57);
      const double wall = to_centimetres(band.y.low + depth);
      rooms = {box_of(x, {band.y.low, wall}), box_of(x, {wall + wall_m_, band.y.high})};
      open({x.low, x.high}, {wall, wall + wall_m_}, kDoorwayM);
    } else {
      rooms = {box_of(x, band.y)};
    }
    const bool below = band.corridor_below && (!both || draw_.chance(0.65));
    const bool above = band.corridor_above && (!below || draw_.chance(0.4));
    double opening = kDoorwayM;
    if (hall_wanted_ && x.length() >= 3.4) {
      opening = to_centimetres(draw_.between(2.2, 2.8));
      hall_wanted_ = false;
      hall_section_ = sections_.size();
    }
    if (below) open(x, {band.y.low - kCorridorWallM, band.y.low}, opening);
    if (above) open(x, {band.y.high, band.y.high + kCorridorWallM}, opening);
    layout_.rooms.insert(layout_.rooms.end(), rooms.begin(), rooms.end());
    return rooms;
  }

  /// An opening of the given width somewhere along x, through the wall that fills `wall` in y.
  void open(Span x, Span wall, double width_m) {
    const double low = to_centimetres(draw_.between(x.low + 0.25, x.high - 0.25 - width_m));
    const double middle = 0.5 * (wall.low + wall.high);
    layout_.openings.push_back(box_of({low, low + width_m}, wall));
    layout_.doorways.push_back({{low, middle}, {low + width_m, middle}});
  }

  void connect_side_by_side(const Box& left, const Box& right) {
    const Span shared{std::max(left.min().y(), right.min().y()),
                      std::min(left.max().y(), right.max().y())};
    if (shared.length() < kDoorwayM + 0.6 || !draw_.chance(0.22)) return;
    const double low =
        to_centimetres(draw_.between(shared.low + 0.25, shared.high - 0.25 - kDoorwayM));
    const double middle = 0.5 * (left.max().x() + right.min().x());
    layout_.openings.push_back(box_of({left.max().x(), right.min().x()}, {low, low + kDoorwayM}));
    layout_.doorways.push_back({{middle, low}, {middle, low + kDoorwayM}});
  }

  Span x_, y_;
  Draw& draw_;
  double wall_m_ = 0.0;
  std::vector<Section> sections_;
  std::size_t hall_section_ =
      0;  ///< where one room stands open to the corridor; none when past the end
  std::size_t left_out_ = 0;  ///< where one corner of the building is missing; the same
  bool hall_wanted_ = false;
  OfficeLayout layout_;
};

}  // namespace

OfficeLayout lay_out_office(double width_m, double depth_m, Draw& draw) {
  return OfficePlanner(width_m, depth_m, draw).plan();
}

}  // namespace lifeline::sources
