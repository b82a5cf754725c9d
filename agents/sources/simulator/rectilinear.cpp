#include "agents/sources/simulator/rectilinear.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lifeline::sources {
namespace {

/// The plane cut along every box's edges: within a field, everything is floor or nothing is.
class Fields {
 public:
  Fields(std::span<const Box> floors, std::span<const Box> solids) {
    for (const auto boxes : {floors, solids}) {
      for (const Box& box : boxes) {
        x_.insert(x_.end(), {box.min().x(), box.max().x()});
        y_.insert(y_.end(), {box.min().y(), box.max().y()});
      }
    }
    for (auto* cuts : {&x_, &y_}) {
      std::sort(cuts->begin(), cuts->end());
      cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
    }
    floor_.assign(x_.size() * y_.size(), 0);
    for (const Box& box : floors) paint(box, 1);
    for (const Box& box : solids) paint(box, 0);
  }

  [[nodiscard]] std::size_t columns() const { return x_.empty() ? 0 : x_.size() - 1; }
  [[nodiscard]] std::size_t rows() const { return y_.empty() ? 0 : y_.size() - 1; }
  [[nodiscard]] double x(std::size_t cut) const { return x_[cut]; }
  [[nodiscard]] double y(std::size_t cut) const { return y_[cut]; }
  /// Column and row count from 1, so that 0 and beyond the last are outside.
  [[nodiscard]] bool floor(std::size_t column, std::size_t row) const {
    if (column == 0 || row == 0 || column > columns() || row > rows()) return false;
    return floor_[(row - 1) * x_.size() + column - 1] != 0;
  }

 private:
  static std::size_t cut(const std::vector<double>& cuts, double value) {
    return static_cast<std::size_t>(std::lower_bound(cuts.begin(), cuts.end(), value) -
                                    cuts.begin());
  }

  void paint(const Box& box, std::uint8_t value) {
    const std::size_t right = cut(x_, box.max().x()), top = cut(y_, box.max().y());
    for (std::size_t row = cut(y_, box.min().y()); row < top; ++row) {
      for (std::size_t column = cut(x_, box.min().x()); column < right; ++column) {
        floor_[row * x_.size() + column] = value;
      }
    }
  }

  std::vector<double> x_, y_;
  std::vector<std::uint8_t> floor_;
};

/// Joins the pieces along one cut: side(i) is 1 or -1 where piece i is border with floor on one or
/// the other side, 0 where it is none; emit(first, last, side) gets each longest run.
template <typename Side, typename Emit>
void join_pieces(std::size_t count, Side side, Emit emit) {
  std::size_t first = 0;
  for (std::size_t i = 1; i <= count; ++i) {
    if (i < count && side(i) == side(first)) continue;
    if (side(first) != 0) emit(first, i, side(first));
    first = i;
  }
}

}  // namespace

std::vector<WallSegment> border_of(std::span<const Box> floors, std::span<const Box> solids) {
  const Fields fields(floors, solids);
  std::vector<WallSegment> border;
  const auto add = [&](Eigen::Vector2d a, Eigen::Vector2d b, bool forward) {
    border.push_back(forward ? WallSegment{a, b} : WallSegment{b, a});
  };
  for (std::size_t row = 0; fields.rows() > 0 && row <= fields.rows(); ++row) {
    const auto side = [&](std::size_t i) {
      return int{fields.floor(i + 1, row + 1)} - int{fields.floor(i + 1, row)};
    };
    join_pieces(fields.columns(), side, [&](std::size_t first, std::size_t last, int above) {
      add({fields.x(first), fields.y(row)}, {fields.x(last), fields.y(row)}, above > 0);
    });
  }
  for (std::size_t column = 0; fields.columns() > 0 && column <= fields.columns(); ++column) {
    const auto side = [&](std::size_t i) {
      return int{fields.floor(column, i + 1)} - int{fields.floor(column + 1, i + 1)};
    };
    join_pieces(fields.rows(), side, [&](std::size_t first, std::size_t last, int left) {
      add({fields.x(column), fields.y(first)}, {fields.x(column), fields.y(last)}, left > 0);
    });
  }
  return border;
}

}  // namespace lifeline::sources
