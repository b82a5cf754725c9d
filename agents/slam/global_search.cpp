#include "agents/slam/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lifeline::slam {
namespace {

/// Fit of a point on a surface, and of one in free space; 0 in the unknown. The sum over 255 points
/// fits 16 bits many times over.
constexpr int kFull = 10;
constexpr int kFree = -4;

int fit(TsdCell cell) {
  if (cell.tsd > TsdCell::kTsdOne * 95 / 100) return kFree;
  return kFull - (kFull * std::abs(int{cell.tsd}) + TsdCell::kTsdOne / 2) / TsdCell::kTsdOne;
}

std::int32_t round_up(double cells, int multiple) {
  return static_cast<std::int32_t>(std::ceil(cells / multiple)) * multiple;
}

}  // namespace

void GlobalSearch::clear() {
  for (auto& level : fit_) level = {};
  phases_ = {};
  free_ = {};
  free_blocks_ = {};
  columns_ = rows_ = 0;
}

void GlobalSearch::set_map(const WorkingMap& map) {
  clear();
  lay_out(map);
  if (columns_ == 0) return;
  fill_fit(map);
  for (int level = 1; level < kLevels; ++level) build_level(level);
  build_phases();
}

void GlobalSearch::lay_out(const WorkingMap& map) {
  const std::vector<TileIndex> tiles = map.tiles();
  if (tiles.empty()) return;
  TileIndex low = tiles.front(), high = low;
  for (const TileIndex tile : tiles) {
    low = {std::min(low.x, tile.x), std::min(low.y, tile.y)};
    high = {std::max(high.x, tile.x), std::max(high.y, tile.y)};
  }
  const double tile_m = map.geometry().cell_size_m * kTileSide;
  origin_m_ = Eigen::Vector2d(low.x, low.y) * tile_m;
  const Eigen::Vector2d size_m(tile_m * (high.x - low.x + 1), tile_m * (high.y - low.y + 1));
  spacing_m_ = config_.spacing_m;
  while (size_m.prod() / (spacing_m_ * spacing_m_) > static_cast<double>(config_.max_cells)) {
    spacing_m_ *= 2.0;
  }
  // A rim of unknown cells: no block reaches into the map from outside the field.
  origin_m_ -= Eigen::Vector2d::Constant(kBlock * spacing_m_);
  columns_ = round_up(size_m.x() / spacing_m_, kBlock) + 2 * kBlock;
  rows_ = round_up(size_m.y() / spacing_m_, kBlock) + 2 * kBlock;
}

void GlobalSearch::fill_fit(const WorkingMap& map) {
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  // The worst first, so that the best of a field's cells remains; what stays is unknown.
  constexpr std::int8_t kUnknown = -128;
  fit_[0].assign(cells, kUnknown);
  free_.assign(cells, 0);
  const double tile_m = map.geometry().cell_size_m * kTileSide;
  for (const TileIndex tile : map.tiles()) {
    if (const TsdTile* found = map.find(tile)) {
      fill_tile(*found, map.geometry(), Eigen::Vector2d(tile.x, tile.y) * tile_m - origin_m_);
    }
  }
  std::replace(fit_[0].begin(), fit_[0].end(), kUnknown, std::int8_t{0});
}

void GlobalSearch::fill_tile(const TsdTile& cells, const GridGeometry& geometry,
                             Eigen::Vector2d corner_m) {
  for (int y = 0; y < kTileSide; ++y) {
    const auto row =
        static_cast<std::int32_t>((corner_m.y() + (y + 0.5) * geometry.cell_size_m) / spacing_m_);
    for (int x = 0; x < kTileSide; ++x) {
      const TsdCell cell = cells[offset_in_tile({x, y})];
      if (!cell.known()) continue;
      const auto column =
          static_cast<std::int32_t>((corner_m.x() + (x + 0.5) * geometry.cell_size_m) / spacing_m_);
      const std::size_t here = at({column, row});
      fit_[0][here] = std::max(fit_[0][here], static_cast<std::int8_t>(fit(cell)));
      free_[here] |= static_cast<std::uint8_t>(cell.tsd > TsdCell::kTsdOne / 2);
    }
  }
}

void GlobalSearch::build_level(int level) {
  const auto& from = fit_[static_cast<std::size_t>(level) - 1];
  auto& to = fit_[static_cast<std::size_t>(level)];
  const int reach = 1 << (level - 1);
  to = from;
  for (std::int32_t row = 0; row < rows_; ++row) {  // along x ...
    const std::int8_t* in = from.data() + at({0, row});
    std::int8_t* out = to.data() + at({0, row});
    for (std::int32_t column = 0; column < columns_; ++column) {
      out[column] =
          std::max(in[column], column + reach < columns_ ? in[column + reach] : std::int8_t{0});
    }
  }
  for (std::int32_t row = 0; row < rows_; ++row) {  // ... then along y, upwards: in place
    std::int8_t* out = to.data() + at({0, row});
    const std::int8_t* above = row + reach < rows_ ? to.data() + at({0, row + reach}) : nullptr;
    for (std::int32_t column = 0; column < columns_; ++column) {
      out[column] = std::max(out[column], above != nullptr ? above[column] : std::int8_t{0});
    }
  }
}

void GlobalSearch::build_phases() {
  const auto& top = fit_[kLevels - 1];
  const std::int32_t block_columns = columns_ / kBlock, block_rows = rows_ / kBlock;
  phases_.resize(top.size());
  free_blocks_.assign(
      static_cast<std::size_t>(block_columns) * static_cast<std::size_t>(block_rows), 0);
  std::int8_t* to = phases_.data();
  for (int y = 0; y < kBlock; ++y) {
    for (int x = 0; x < kBlock; ++x) {
      std::uint8_t* free_block = free_blocks_.data();
      for (std::int32_t row = 0; row < block_rows; ++row) {
        for (std::int32_t column = 0; column < block_columns; ++column) {
          const std::size_t here = at({column * kBlock + x, row * kBlock + y});
          *to++ = top[here];
          *free_block++ |= free_[here];
        }
      }
    }
  }
}

GlobalSearchResult GlobalSearch::search(std::span<const Eigen::Vector2d> points, double yaw_rad,
                                        double window_rad) {
  found_.clear();
  best_ = 0;
  complete_ = true;
  nodes_left_ = config_.max_nodes;
  choose_points(points);
  if (points_.empty() || !has_map()) return {};
  double lever2_m2 = 0.0;
  for (const Eigen::Vector2d& p : points_) lever2_m2 += p.squaredNorm();
  const double lever_m = std::sqrt(lever2_m2 / static_cast<double>(points_.size()));
  const double step_rad = std::clamp(1.5 * spacing_m_ / lever_m, 0.01, 0.06);
  const int yaws = static_cast<int>(std::ceil(std::min(window_rad, M_PI) / step_rad));
  std::vector<Node> nodes;
  for (int k = -yaws; k <= yaws; ++k) {
    turn_points(yaw_rad + k * step_rad);
    bound_blocks(k, nodes);
  }
  std::stable_sort(nodes.begin(), nodes.end(),
                   [](const Node& a, const Node& b) { return a.bound > b.bound; });
  int turned = yaws + 1;
  for (const Node& node : nodes) {
    if (node.bound < least_score()) break;
    if (node.yaw != turned) turn_points(yaw_rad + node.yaw * step_rad);
    turned = node.yaw;
    descend(node.corner, kLevels - 1, yaw_rad + node.yaw * step_rad);
    if (nodes_left_ <= 0) break;
  }
  complete_ = complete_ && nodes_left_ > 0;
  std::stable_sort(found_.begin(), found_.end(),
                   [](const auto& a, const auto& b) { return a.agreement > b.agreement; });
  return {found_, complete_};
}

void GlobalSearch::choose_points(std::span<const Eigen::Vector2d> points) {
  const auto most = static_cast<std::size_t>(config_.max_points);
  const std::size_t count = std::min(points.size(), most);
  points_.clear();
  for (std::size_t i = 0; i < count; ++i) points_.push_back(points[i * points.size() / count]);
  // So that the first few, which decide whether to go on, stand all around.
  std::vector<Eigen::Vector2d> mixed;
  constexpr std::size_t kStride = 16;
  for (std::size_t first = 0; first < kStride; ++first) {
    for (std::size_t i = first; i < count; i += kStride) mixed.push_back(points_[i]);
  }
  points_ = std::move(mixed);
}

void GlobalSearch::turn_points(double yaw_rad) {
  const double c = std::cos(yaw_rad) / spacing_m_, s = std::sin(yaw_rad) / spacing_m_;
  offsets_.clear();
  for (const Eigen::Vector2d& p : points_) {
    offsets_.push_back({static_cast<std::int32_t>(std::floor(0.5 + c * p.x() - s * p.y())),
                        static_cast<std::int32_t>(std::floor(0.5 + s * p.x() + c * p.y()))});
  }
}

void GlobalSearch::bound_blocks(int yaw, std::vector<Node>& nodes) {
  const std::int32_t columns = columns_ / kBlock, rows = rows_ / kBlock;
  const auto blocks = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  sums_.assign(blocks, 0);
  for (const Place& offset : offsets_) {
    const int phase = (offset.row & (kBlock - 1)) * kBlock + (offset.column & (kBlock - 1));
    const std::int32_t right = offset.column >> (kLevels - 1), up = offset.row >> (kLevels - 1);
    const std::int32_t first = std::max(0, -right), last = std::min(columns, columns - right);
    const std::int8_t* field = phases_.data() + static_cast<std::size_t>(phase) * blocks;
    for (std::int32_t row = std::max(0, -up); row < std::min(rows, rows - up); ++row) {
      const std::int8_t* from = field + std::ptrdiff_t{row + up} * columns + right;
      std::int16_t* sum = sums_.data() + std::ptrdiff_t{row} * columns;
      for (std::int32_t i = first; i < last; ++i) {
        sum[i] = static_cast<std::int16_t>(sum[i] + from[i]);
      }
    }
  }
  const int least = least_score();
  for (std::size_t i = 0; i < blocks; ++i) {
    if (sums_[i] < least || free_blocks_[i] == 0) continue;
    const auto block = static_cast<std::int32_t>(i);
    nodes.push_back({sums_[i], yaw, {block % columns * kBlock, block / columns * kBlock}});
  }
}

int GlobalSearch::score(int level, Place corner, int least) const {
  const auto& field = fit_[static_cast<std::size_t>(level)];
  constexpr std::size_t kAtOnce = 16;
  int sum = 0;
  for (std::size_t i = 0; i < offsets_.size();) {
    const std::size_t end = std::min(i + kAtOnce, offsets_.size());
    for (; i < end; ++i) {
      const Place cell{corner.column + offsets_[i].column, corner.row + offsets_[i].row};
      if (cell.column < 0 || cell.row < 0 || cell.column >= columns_ || cell.row >= rows_) continue;
      sum += field[at(cell)];
    }
    if (sum + kFull * static_cast<int>(offsets_.size() - i) < least) return sum - 1'000'000;
  }
  return sum;
}

void GlobalSearch::descend(Place corner, int level, double yaw_rad) {
  if (level == 0) {
    if (free_[at(corner)] != 0) note(score(0, corner, least_score()), corner, yaw_rad);
    return;
  }
  const int half = 1 << (level - 1);
  std::array<std::pair<int, Place>, 4> children;
  for (std::size_t i = 0; i < 4; ++i) {
    const Place child{corner.column + (i % 2 == 1 ? half : 0), corner.row + (i > 1 ? half : 0)};
    children[i] = {score(level - 1, child, least_score()), child};
  }
  nodes_left_ -= 4;
  std::stable_sort(children.begin(), children.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [bound, child] : children) {
    if (bound < least_score() || nodes_left_ <= 0) break;
    descend(child, level - 1, yaw_rad);
  }
}

void GlobalSearch::note(int score, Place place, double yaw_rad) {
  if (score < least_score()) return;
  best_ = std::max(best_, score);
  const Eigen::Vector2d at_m =
      origin_m_ + spacing_m_ * Eigen::Vector2d(place.column + 0.5, place.row + 0.5);
  const GlobalCandidate here{
      {at_m.x(), at_m.y(), normalise_angle(yaw_rad)},
      static_cast<double>(score) / kFull / static_cast<double>(points_.size())};
  const auto same = std::find_if(found_.begin(), found_.end(), [&](const GlobalCandidate& other) {
    const Pose2 &a = here.T_map_head, &b = other.T_map_head;
    return (a.translation() - b.translation()).norm() < config_.apart_m &&
           std::abs(normalise_angle(a.yaw_rad - b.yaw_rad)) < config_.apart_rad;
  });
  if (same != found_.end()) {
    if (here.agreement > same->agreement) *same = here;
    return;
  }
  const double hopeless =
      static_cast<double>(least_score()) / kFull / static_cast<double>(points_.size());
  std::erase_if(found_, [&](const GlobalCandidate& other) { return other.agreement < hopeless; });
  if (found_.size() < config_.max_candidates) {
    found_.push_back(here);
    return;
  }
  complete_ = false;
  const auto worst =
      std::min_element(found_.begin(), found_.end(),
                       [](const auto& a, const auto& b) { return a.agreement < b.agreement; });
  if (here.agreement > worst->agreement) *worst = here;
}

int GlobalSearch::least_score() const {
  const double points = static_cast<double>(points_.size());
  return std::max(static_cast<int>(std::ceil(config_.min_agreement * kFull * points)),
                  best_ - static_cast<int>(config_.margin * kFull * points));
}

}  // namespace lifeline::slam
