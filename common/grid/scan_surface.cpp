#include "common/grid/scan_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace lifeline {
namespace {

float spread_between(const Beam2& a, const Beam2& b) {
  constexpr float kTurn = 6.2831853F;
  const float apart_rad = std::abs(a.angle_rad - b.angle_rad);
  return std::min(apart_rad, std::abs(kTurn - apart_rad));
}

/// Hits merged to points of one run: neighbours on one surface.
struct RunPoint {
  Eigen::Vector2d p;
  double along_m = 0.0;  ///< path length within the run
};

struct Line {
  Eigen::Vector2d mean;
  Eigen::Vector2d normal;
  double rms_m = 0.0;
};

/// Sums over a run's points, so that a line through any stretch of it costs the same.
class RunSums {
 public:
  explicit RunSums(std::span<const RunPoint> points) : origin_(points.front().p) {
    sums_.reserve(points.size() + 1);
    sums_.push_back({});
    for (const RunPoint& point : points) {
      const Eigen::Vector2d d = point.p - origin_;
      Sums next = sums_.back();
      next.first += d;
      next.xx += d.x() * d.x();
      next.xy += d.x() * d.y();
      next.yy += d.y() * d.y();
      sums_.push_back(next);
    }
  }

  /// The line through the points first ... last (inclusive), at least two.
  [[nodiscard]] Line fit(std::size_t first, std::size_t last) const {
    const Sums &high = sums_[last + 1], &low = sums_[first];
    const auto n = static_cast<double>(last + 1 - first);
    const Eigen::Vector2d mean = (high.first - low.first) / n;
    const double xx = (high.xx - low.xx) / n - mean.x() * mean.x();
    const double xy = (high.xy - low.xy) / n - mean.x() * mean.y();
    const double yy = (high.yy - low.yy) / n - mean.y() * mean.y();
    const double half_difference = 0.5 * (xx - yy);
    const double root = std::sqrt(half_difference * half_difference + xy * xy);
    const double least = std::max(0.0, 0.5 * (xx + yy) - root);
    // The eigenvector of the larger eigenvalue is the direction; of its two forms the one that does
    // not cancel.
    Eigen::Vector2d along = half_difference >= 0.0 ? Eigen::Vector2d(half_difference + root, xy)
                                                   : Eigen::Vector2d(xy, root - half_difference);
    const double length = along.norm();
    along = length > 0.0 ? Eigen::Vector2d(along / length) : Eigen::Vector2d::UnitX();
    return {origin_ + mean, {-along.y(), along.x()}, std::sqrt(least)};
  }

 private:
  struct Sums {
    Eigen::Vector2d first = Eigen::Vector2d::Zero();
    double xx = 0.0, xy = 0.0, yy = 0.0;
  };
  Eigen::Vector2d origin_;
  std::vector<Sums> sums_;
};

/// Turns one run into pieces.
class RunFitter {
 public:
  RunFitter(std::span<const RunPoint> run, double spread_rad, const SurfaceConfig& config)
      : run_(run), spread_rad_(spread_rad), config_(config), sums_(run) {}

  /// `link` is that of the run's first piece.
  void append_to(std::vector<SurfacePiece>& pieces, SurfaceLink link) {
    for (std::size_t i = 0; i < run_.size(); ++i) {
      pieces.push_back(piece(i));
      pieces.back().link = i == 0 ? link : SurfaceLink::joined;
    }
  }

 private:
  [[nodiscard]] SurfacePiece piece(std::size_t i) {
    const Eigen::Vector2d& p = run_[i].p;
    const double range_m = p.norm();
    Line line{p, -p / range_m, 0.0};
    if (run_.size() > 1) line = best_line(i);
    if (line.normal.dot(p) > 0.0) line.normal = -line.normal;
    const double off_m = line.normal.dot(p - line.mean);
    const double incidence = std::clamp(-line.normal.dot(p) / range_m, 0.0, 1.0);
    SurfacePiece piece;
    piece.has_normal = run_.size() > 1;
    piece.point = (p - off_m * line.normal).cast<float>();
    piece.normal = line.normal.cast<float>();
    set_extent(i, line.normal, range_m, piece);
    const double fit = line.rms_m > config_.line_rms_m ? 0.5 : 1.0;
    const double sway_m = config_.heading_sigma_rad * range_m;
    const double across_m2 = sway_m * sway_m * (1.0 - incidence * incidence);
    const double noise_m2 = config_.range_sigma_m * config_.range_sigma_m;
    piece.quality = static_cast<float>(fit * (piece.has_normal ? 1.0 : 0.15) * noise_m2 /
                                       (noise_m2 + across_m2));
    return piece;
  }

  /// The line through the neighbours on both sides or, at a corner, on the straighter side.
  [[nodiscard]] Line best_line(std::size_t i) {
    const double reach_m = config_.fit_radius_m;
    while (run_[i].along_m - run_[first_].along_m > reach_m) ++first_;
    last_ = std::max(last_, i);
    while (last_ + 1 < run_.size() && run_[last_ + 1].along_m - run_[i].along_m <= reach_m) ++last_;
    const std::size_t first = i == 0 ? 0 : std::min(first_, i - 1);
    const std::size_t last = std::min(std::max(last_, i + 1), run_.size() - 1);
    Line best = sums_.fit(first, last);
    if (best.rms_m <= config_.line_rms_m) return best;
    if (first < i) best = straighter(best, sums_.fit(first, i));
    if (last > i) best = straighter(best, sums_.fit(i, last));
    return best;
  }

  static Line straighter(const Line& a, const Line& b) { return b.rms_m < a.rms_m ? b : a; }

  void set_extent(std::size_t i, const Eigen::Vector2d& normal, double range_m,
                  SurfacePiece& piece) const {
    const Eigen::Vector2d left(-normal.y(), normal.x());
    double on_left_m = -1.0, on_right_m = -1.0;
    const auto note = [&](std::size_t neighbour) {
      const double half_m = 0.5 * left.dot(run_[neighbour].p - run_[i].p);
      (half_m > 0.0 ? on_left_m : on_right_m) = std::abs(half_m);
    };
    if (i > 0) note(i - 1);
    if (i + 1 < run_.size()) note(i + 1);
    // Where a surface ends, it is taken to reach as far as its beam is wide.
    const double end_m = std::min(0.05, 0.5 * range_m * spread_rad_);
    piece.left_m = static_cast<float>(on_left_m < 0.0 ? end_m : on_left_m);
    piece.right_m = static_cast<float>(on_right_m < 0.0 ? end_m : on_right_m);
  }

  std::span<const RunPoint> run_;
  double spread_rad_;
  const SurfaceConfig& config_;
  RunSums sums_;
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

/// Walks the sweep and cuts it into runs.
class SurfaceExtractor {
 public:
  SurfaceExtractor(const Scan2& scan, const SurfaceConfig& config) : scan_(scan), config_(config) {}

  std::vector<SurfacePiece> extract() {
    const std::size_t n = scan_.beams.size();
    pieces_.reserve(n);
    const std::size_t start = scan_.full_circle ? first_break() : 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (start + k) % n;
      if (scan_.beams[i].kind != BeamKind::hit) continue;
      const SurfaceLink link = link_of(i);
      if (link != SurfaceLink::joined || k == 0) {
        finish_run();
        run_link_ = link;
      }
      add(scan_.beams[i]);
    }
    finish_run();
    return std::move(pieces_);
  }

 private:
  /// The beam `offset` places on; nullptr beyond the ends of the sweep.
  [[nodiscard]] const Beam2* neighbour(std::size_t i, int offset) const {
    const auto n = static_cast<std::ptrdiff_t>(scan_.beams.size());
    const auto at = static_cast<std::ptrdiff_t>(i) + offset;
    if (at >= 0 && at < n) return &scan_.beams[static_cast<std::size_t>(at)];
    if (!scan_.full_circle) return nullptr;
    return &scan_.beams[static_cast<std::size_t>((at + n) % n)];
  }

  /// How beam i, a hit, goes with the beam before it.
  [[nodiscard]] SurfaceLink link_of(std::size_t i) const {
    const Beam2& beam = scan_.beams[i];
    const Beam2* before = neighbour(i, -1);
    if (before == nullptr || before->kind != BeamKind::hit) return SurfaceLink::none;
    const float spread_rad = spread_between(*before, beam);
    if (spread_rad > config_.max_spread_rad) return SurfaceLink::none;
    const float apart_m = std::hypot(before->x_m - beam.x_m, before->y_m - beam.y_m);
    // Four times the spacing of a surface seen head-on: seen at less than about 14 deg, it falls
    // apart.
    const float spacing_m = spread_rad * std::min(before->range_m, beam.range_m);
    if (apart_m <= std::min(config_.max_gap_m, 0.08F + 4.0F * spacing_m)) {
      return SurfaceLink::joined;
    }
    if (apart_m > config_.max_gap_in_line_m) return SurfaceLink::jump;
    return in_line(neighbour(i, -2), *before, beam) || in_line(neighbour(i, 1), beam, *before)
               ? SurfaceLink::joined
               : SurfaceLink::jump;
  }

  /// Whether `outer`, if it is a hit, lies in line with its neighbour `middle` and the next,
  /// `inner`.
  [[nodiscard]] bool in_line(const Beam2* outer, const Beam2& middle, const Beam2& inner) const {
    if (outer == nullptr || outer->kind != BeamKind::hit) return false;
    const Eigen::Vector2f a(middle.x_m - outer->x_m, middle.y_m - outer->y_m);
    const Eigen::Vector2f b(inner.x_m - middle.x_m, inner.y_m - middle.y_m);
    const float a_m = a.norm();
    constexpr float kStraight = 0.985F;  // cosine of 10 deg
    return a_m <= config_.max_gap_in_line_m && a.dot(b) >= kStraight * a_m * b.norm();
  }

  [[nodiscard]] std::size_t first_break() const {
    for (std::size_t i = 0; i < scan_.beams.size(); ++i) {
      if (scan_.beams[i].kind != BeamKind::hit || link_of(i) != SurfaceLink::joined) return i;
    }
    return 0;
  }

  void add(const Beam2& beam) {
    const Eigen::Vector2d p(beam.x_m, beam.y_m);
    if (merged_ > 0 && (p - merge_start_).norm() < config_.merge_m) {
      merge_sum_ += p;
      ++merged_;
      return;
    }
    finish_point();
    merge_start_ = merge_sum_ = p;
    merged_ = 1;
  }

  void finish_point() {
    if (merged_ == 0) return;
    const Eigen::Vector2d p = merge_sum_ / merged_;
    merged_ = 0;
    if (p.squaredNorm() < 1e-4) return;  // at the lidar itself: no direction
    const double along_m = run_.empty() ? 0.0 : run_.back().along_m + (p - run_.back().p).norm();
    run_.push_back({p, along_m});
  }

  void finish_run() {
    finish_point();
    if (run_.empty()) return;
    RunFitter(run_, typical_spread(), config_).append_to(pieces_, run_link_);
    run_.clear();
  }

  [[nodiscard]] double typical_spread() const {
    return scan_.beams.size() < 2
               ? 0.0
               : static_cast<double>(spread_between(scan_.beams[0], scan_.beams[1]));
  }

  const Scan2& scan_;
  const SurfaceConfig& config_;
  std::vector<SurfacePiece> pieces_;
  std::vector<RunPoint> run_;
  SurfaceLink run_link_ = SurfaceLink::none;
  Eigen::Vector2d merge_start_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d merge_sum_ = Eigen::Vector2d::Zero();
  int merged_ = 0;
};

}  // namespace

std::vector<SurfacePiece> extract_surface(const Scan2& scan, const SurfaceConfig& config) {
  if (scan.beams.empty()) return {};
  return SurfaceExtractor(scan, config).extract();
}

}  // namespace lifeline
