#include "common/grid/free_outline.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline {
namespace {

/// How far along its beam free space is sure to reach before a piece: to a truncation distance from
/// the surface, measured across it.
float free_reach(const SurfacePiece& piece, float truncation_m) {
  const float range_m = piece.point.norm();
  const float incidence = std::max(-piece.normal.dot(piece.point) / range_m, 0.05F);
  return std::max(0.0F, range_m - truncation_m / incidence);
}

/// The same where a surface may run from `piece` to the nearer neighbour `edge`, unseen.
float free_reach_beside(const SurfacePiece& piece, const SurfacePiece& edge, float truncation_m) {
  const Eigen::Vector2f chord = edge.point - piece.point;
  const float range_m = piece.point.norm();
  const float across = std::abs(chord.x() * piece.point.y() - chord.y() * piece.point.x()) /
                       std::max(chord.norm() * range_m, 1e-6F);
  return std::max(0.0F, range_m - truncation_m / std::max(across, 1e-3F));
}

}  // namespace

void FreeOutline::set_reaches(std::span<const SurfacePiece> pieces, float truncation_m) {
  const std::size_t n = pieces.size();
  reach_m_.resize(n);
  for (std::size_t i = 0; i < n; ++i) reach_m_[i] = free_reach(pieces[i], truncation_m);
  for (std::size_t i = 0; i < n; ++i) {
    if (pieces[i].link != SurfaceLink::jump) continue;
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    const bool is_near = pieces[i].point.squaredNorm() < pieces[before].point.squaredNorm();
    const std::size_t near = is_near ? i : before, far = is_near ? before : i;
    reach_m_[far] =
        std::min(reach_m_[far], free_reach_beside(pieces[far], pieces[near], truncation_m));
  }
}

void FreeOutline::trace(std::span<const SurfacePiece> pieces, const Pose2& T_raster_head,
                        const GridGeometry& geometry) {
  outline_.clear();
  set_reaches(pieces, static_cast<float>(geometry.truncation_m));
  const auto cell_m = static_cast<float>(geometry.cell_size_m);
  const auto c = static_cast<float>(std::cos(T_raster_head.yaw_rad)) / cell_m;
  const auto s = static_cast<float>(std::sin(T_raster_head.yaw_rad)) / cell_m;
  const Eigen::Vector2f head(static_cast<float>(T_raster_head.x_m),
                             static_cast<float>(T_raster_head.y_m));
  const auto add = [&](std::size_t direction_of, float reach_m) {
    const Eigen::Vector2f p =
        pieces[direction_of].point * (reach_m / pieces[direction_of].point.norm());
    outline_.emplace_back(head.x() + c * p.x() - s * p.y(), head.y() + s * p.x() + c * p.y());
  };
  const std::size_t n = pieces.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    if (pieces[i].link == SurfaceLink::none) outline_.push_back(head);
    // Between surfaces of different depth, only what lies before both is sure to be free.
    if (pieces[i].link == SurfaceLink::jump) {
      const bool rises = reach_m_[before] < reach_m_[i];
      add(rises ? i : before, std::min(reach_m_[before], reach_m_[i]));
    }
    add(i, reach_m_[i]);
  }
}

std::span<const FreeOutline::Run> FreeOutline::runs(std::int32_t rows) {
  runs_.clear();
  if (outline_.size() < 3) return runs_;
  find_crossings(rows);
  for (std::int32_t row = 0; row < rows; ++row) {
    const auto begin = static_cast<std::size_t>(row_start_[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(row_start_[static_cast<std::size_t>(row) + 1]);
    if (begin < end) add_runs(row, std::span(crossings_).subspan(begin, end - begin));
  }
  return runs_;
}

void FreeOutline::find_crossings(std::int32_t rows) {
  found_.clear();
  found_row_.clear();
  row_start_.assign(static_cast<std::size_t>(rows) + 1, 0);
  Eigen::Vector2f a = outline_.back();
  for (const Eigen::Vector2f& b : outline_) {
    const bool up = b.y() > a.y();
    const Eigen::Vector2f &low = up ? a : b, &high = up ? b : a;
    const std::int32_t first = std::max(first_centre_from(low.y()), 0);
    const std::int32_t end = std::min(first_centre_from(high.y()), rows);
    if (first < end) {
      const float slope = (high.x() - low.x()) / (high.y() - low.y());
      for (std::int32_t row = first; row < end; ++row) {
        const float x = low.x() + slope * (static_cast<float>(row) + 0.5F - low.y());
        found_.push_back({x, up ? 1 : -1});
        found_row_.push_back(row);
        ++row_start_[static_cast<std::size_t>(row)];
      }
    }
    a = b;
  }
  std::int32_t total = 0;
  for (std::int32_t& start : row_start_) total = start += total;
  crossings_.resize(found_.size());
  // row_start_ holds the ends now; filling from behind turns them into the starts.
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const auto row = static_cast<std::size_t>(found_row_[i]);
    crossings_[static_cast<std::size_t>(--row_start_[row])] = found_[i];
  }
}

void FreeOutline::add_runs(std::int32_t row, std::span<Crossing> crossings) {
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
  std::int32_t winding = crossings.front().direction;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    if (winding != 0) {
      runs_.push_back(
          {row, first_centre_from(crossings[i - 1].x), first_centre_from(crossings[i].x) - 1});
    }
    winding += crossings[i].direction;
  }
}

}  // namespace lifeline
