#include "tests/bench/paper/panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/files/atomic_file.hpp"
#include "common/files/canvas.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace lifeline::bench {
namespace {

using files::Canvas;
using files::Colour;

constexpr double kPixelsPerM = 20.0;
constexpr double kMarginM = 1.0;
constexpr int kTitlePx = 22;
constexpr int kGapPx = 8;
constexpr Colour kPage = 0xffffff, kUnknown = 0xd5dae0, kFree = 0xffffff, kWall = 0x1f2a37;
constexpr Colour kPlan = 0xd62728;
constexpr std::array<Colour, 2> kPaths{0x0072b2, 0xe69f00};

class Sheet {
 public:
  Sheet(const sources::FloorPlan& plan, std::size_t panels, int columns)
      : plan_(plan), box_(plan.bounds()), columns_(columns) {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMarginM);
    box_ = Eigen::AlignedBox2d(box_.min() - margin, box_.max() + margin);
    width_px_ = static_cast<int>(std::lround(box_.sizes().x() * kPixelsPerM));
    height_px_ = static_cast<int>(std::lround(box_.sizes().y() * kPixelsPerM));
    const int rows = (static_cast<int>(panels) + columns - 1) / columns;
    canvas_.emplace(columns * (width_px_ + kGapPx), rows * (height_px_ + kTitlePx + kGapPx), kPage);
  }

  [[nodiscard]] Result<void> draw(std::size_t place, const Panel& panel) {
    const auto occupancy = to_occupancy(*panel.map);
    if (!occupancy) return forward_error(occupancy);
    const int column = static_cast<int>(place) % columns_, row = static_cast<int>(place) / columns_;
    const double left = column * (width_px_ + kGapPx),
                 top = row * (height_px_ + kTitlePx + kGapPx) + kTitlePx;
    canvas_->text(left + 2.0, top - 6.0, panel.title, {.size_px = 13.0, .bold = true});
    canvas_->pixels(left, top, width_px_, height_px_, colours(*occupancy, panel.T_world_map));
    canvas_->enter(left, top, width_px_, height_px_);
    for (const auto& wall : plan_.walls) {
      canvas_->line({to_px(wall.a), to_px(wall.b)}, 0.8, kPlan, false, 0.7);
    }
    for (const auto& pane : plan_.panes) {
      canvas_->line({to_px(pane.a), to_px(pane.b)}, 0.8, kPlan, true, 0.7);
    }
    for (std::size_t i = 0; i < panel.paths.size(); ++i) {
      std::vector<Eigen::Vector2d> points;
      for (const auto& p : panel.paths[i]) points.push_back(to_px(p));
      if (points.size() > 1) canvas_->line(points, 1.2, kPaths[i % kPaths.size()], false, 0.8);
    }
    canvas_->leave();
    return {};
  }

  [[nodiscard]] Result<std::string> to_png() { return canvas_->finish(); }

 private:
  [[nodiscard]] Eigen::Vector2d to_px(const Eigen::Vector2d& p_world) const {
    return {(p_world.x() - box_.min().x()) * kPixelsPerM,
            (box_.max().y() - p_world.y()) * kPixelsPerM};
  }

  /// A pixel is a cell or so: a wall in any of its quarters makes it a wall.
  [[nodiscard]] std::vector<std::optional<Colour>> colours(const OccupancyGrid& grid,
                                                           const Pose2& T_world_map) const {
    const Pose2 T_map_world = T_world_map.inverse();
    std::vector<std::optional<Colour>> colours;
    for (int y = 0; y < height_px_; ++y) {
      for (int x = 0; x < width_px_; ++x) {
        Occupancy seen = Occupancy::unknown;
        for (const auto& [dx, dy] :
             {std::pair{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
          const Eigen::Vector2d p_world(box_.min().x() + (x + dx) / kPixelsPerM,
                                        box_.max().y() - (y + dy) / kPixelsPerM);
          const Eigen::Vector2d p = (T_map_world * p_world - grid.origin_m) / grid.cell_size_m;
          seen = std::max(seen, grid.at(static_cast<int>(std::floor(p.x())),
                                        static_cast<int>(std::floor(p.y()))));
        }
        colours.push_back(seen == Occupancy::unknown ? kUnknown
                          : seen == Occupancy::free  ? kFree
                                                     : kWall);
      }
    }
    return colours;
  }

  const sources::FloorPlan& plan_;
  Eigen::AlignedBox2d box_;
  int columns_;
  int width_px_ = 0, height_px_ = 0;
  std::optional<Canvas> canvas_;
};

}  // namespace

Result<void> draw_panels(const std::filesystem::path& file, const sources::FloorPlan& plan,
                         const std::vector<Panel>& panels, int columns) {
  Sheet sheet(plan, panels.size(), columns);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (const auto drawn = sheet.draw(i, panels[i]); !drawn) return drawn;
  }
  const auto png = sheet.to_png();
  if (!png) return forward_error(png);
  return files::write_file_atomically(file, *png);
}

}  // namespace lifeline::bench
