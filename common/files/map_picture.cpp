#include "common/files/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "common/files/atomic_file.hpp"
#include "common/files/canvas.hpp"
#include "common/files/picture_raster.hpp"

namespace lifeline::files {
namespace {

constexpr Colour kPage = 0xffffff, kInk = 0x1f2a37, kFaintInk = 0x5b6776;
constexpr Colour kWall = 0x1f2a37, kExplored = 0xffffff;
constexpr Colour kUnknown = 0xdde2e8, kHatch = 0xcbd2da, kFrame = 0xa9b3bf;
/// Okabe and Ito without vermillion, which is kept for mayday, and without black, the walls' own.
constexpr std::array<Colour, 6> kPathColours{0x0072b2, 0xe69f00, 0x009e73,
                                             0xcc79a7, 0x56b4e9, 0xf0e442};
constexpr int kLeastSide_px = 400;
constexpr int kMapAim_px = 1500, kMapMost_px = 3000;
constexpr std::size_t kMostLegendRows = 4;

/// How a path is told from the others: by colour, then by dashes.
struct PathLook {
  Colour colour = 0;
  bool dashed = false;
};

PathLook look_of(const PicturePath& path, std::size_t place) {
  const std::size_t number = path.colour.value_or(place);
  return {kPathColours[number % kPathColours.size()], number / kPathColours.size() % 2 == 1};
}

/// One word of the legend with the sign before it.
struct LegendEntry {
  std::string name;
  std::function<void(Canvas&, double x, double y, double size)> draw_sign;
};

void draw_box(Canvas& canvas, double x, double y, double size, Colour fill, bool hatched) {
  canvas.fill_rectangle(x, y, size, size, kFrame);
  canvas.enter(x + 1.0, y + 1.0, size - 2.0, size - 2.0);
  canvas.fill_rectangle(0.0, 0.0, size, size, fill);
  if (hatched) canvas.hatch(size, size, size / 2.0, kFaintInk);
  canvas.leave();
}

std::vector<LegendEntry> legend_of(const std::vector<PicturePath>& paths) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    entries.push_back(
        {paths[i].name,
         [look = look_of(paths[i], i)](Canvas& canvas, double x, double y, double size) {
           const double middle = y + size / 2.0;
           canvas.line({{x, middle}, {x + size, middle}}, size / 5.0, look.colour, look.dashed);
           canvas.disc({x + size, middle}, size / 4.0, look.colour, kPage);
         }});
  }
  const auto box = [](Colour fill, bool hatched) {
    return [=](Canvas& canvas, double x, double y, double size) {
      draw_box(canvas, x, y, size, fill, hatched);
    };
  };
  entries.push_back({"explored", box(kExplored, false)});
  entries.push_back({"wall", box(kWall, false)});
  entries.push_back({"not explored", box(kUnknown, true)});
  return entries;
}

/// The whole sheet: title, legend, map, foot. All lengths in pixels.
class Sheet {
 public:
  Sheet(const OccupancyGrid& grid, const std::vector<PicturePath>& paths, std::string title)
      : raster_(to_picture_raster(grid, kMapAim_px, kMapMost_px)),
        paths_(paths),
        legend_(legend_of(paths)),
        title_(std::move(title)),
        explored_m2_(static_cast<double>(known_cells(grid)) * grid.cell_size_m * grid.cell_size_m) {
    size_ = std::clamp(raster_.width_px / 62.0, 13.0, 40.0);
    width_ = std::max(raster_.width_px + 2.0 * size_, double{kLeastSide_px});
    arrange_legend();
    map_y_ = (3.0 + 1.8 * static_cast<double>(rows_.size())) * size_;
    map_height_ = std::max<double>(raster_.height_px, kLeastSide_px - map_y_ - 3.5 * size_);
    height_ = map_y_ + map_height_ + 3.5 * size_;
  }

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }

  void draw(Canvas& canvas) const {
    const Canvas::TextStyle style{1.35 * size_, true, kInk};
    canvas.text(size_, 2.0 * size_, canvas.fitted(title_, width_ - 2.0 * size_, style), style);
    draw_legend(canvas);
    draw_map(canvas);
    draw_foot(canvas);
  }

 private:
  [[nodiscard]] Canvas::TextStyle plain() const { return {size_, false, kInk}; }
  [[nodiscard]] double map_width() const { return width_ - 2.0 * size_; }

  /// Where each entry stands: in as few rows as hold them.
  void arrange_legend() {
    Canvas ruler(1, 1, kPage);
    double x = width_;
    for (auto& entry : legend_) {
      entry.name = ruler.fitted(entry.name, map_width() - 2.0 * size_, plain());
      const double wide = 1.6 * size_ + ruler.text_width(entry.name, plain()) + 1.6 * size_;
      if (x + wide > width_) {
        rows_.emplace_back();
        x = size_;
      }
      rows_.back().push_back(x);
      x += wide;
    }
    if (rows_.size() > kMostLegendRows) rows_.resize(kMostLegendRows);
  }

  void draw_legend(Canvas& canvas) const {
    std::size_t entry = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const double base = (4.0 + 1.8 * static_cast<double>(row)) * size_;
      for (const double x : rows_[row]) {
        legend_[entry].draw_sign(canvas, x, base - 0.85 * size_, size_);
        canvas.text(x + 1.6 * size_, base, legend_[entry].name, plain());
        ++entry;
      }
    }
  }

  void draw_map(Canvas& canvas) const {
    canvas.fill_rectangle(size_ - 1.0, map_y_ - 1.0, map_width() + 2.0, map_height_ + 2.0, kFrame);
    canvas.enter(size_, map_y_, map_width(), map_height_);
    canvas.fill_rectangle(0.0, 0.0, map_width(), map_height_, kUnknown);
    canvas.hatch(map_width(), map_height_, 0.8 * size_, kHatch);
    const double left = std::floor((map_width() - raster_.width_px) / 2.0);
    const double top = std::floor((map_height_ - raster_.height_px) / 2.0);
    canvas.pixels(left, top, raster_.width_px, raster_.height_px, colours());
    const Eigen::Vector2d corner(left, top);
    std::vector<std::vector<Eigen::Vector2d>> lines;
    for (const auto& path : paths_) lines.push_back(on_sheet(path, corner));
    for (std::size_t i = 0; i < lines.size(); ++i)
      draw_path(canvas, lines[i], look_of(paths_[i], i));
    for (std::size_t i = 0; i < lines.size(); ++i) draw_ends(canvas, lines[i], i);
    if (explored_m2_ == 0.0) {
      canvas.text(size_, 2.0 * size_, "nothing explored yet", plain());
    }
    canvas.leave();
  }

  [[nodiscard]] std::vector<std::optional<Colour>> colours() const {
    std::vector<std::optional<Colour>> colours;
    colours.reserve(raster_.pixels.size());
    for (const Occupancy pixel : raster_.pixels) {
      if (pixel == Occupancy::unknown) {
        colours.emplace_back();
      } else {
        colours.emplace_back(pixel == Occupancy::free ? kExplored : kWall);
      }
    }
    return colours;
  }

  [[nodiscard]] std::vector<Eigen::Vector2d> on_sheet(const PicturePath& path,
                                                      const Eigen::Vector2d& corner) const {
    constexpr double kFarthest_px = 1e6;  // cairo counts in 24 bits before the point
    std::vector<Eigen::Vector2d> points;
    for (const auto& p_map : path.points) {
      const Eigen::Vector2d pixel = raster_.to_pixel(p_map) + corner;
      if (pixel.allFinite() && pixel.cwiseAbs().maxCoeff() < kFarthest_px) points.push_back(pixel);
    }
    return points;
  }

  void draw_path(Canvas& canvas, const std::vector<Eigen::Vector2d>& points,
                 const PathLook& look) const {
    canvas.line(points, 0.30 * size_, kPage, false, 0.7);
    canvas.line(points, 0.18 * size_, look.colour, look.dashed);
  }

  void draw_ends(Canvas& canvas, const std::vector<Eigen::Vector2d>& points, std::size_t i) const {
    if (points.empty()) return;
    const Colour colour = look_of(paths_[i], i).colour;
    canvas.disc(points.front(), 0.32 * size_, kPage, colour);
    canvas.disc(points.back(), 0.42 * size_, colour, kPage);
    const Canvas::TextStyle style{0.9 * size_, true, kInk, true};
    const double wide = canvas.text_width(paths_[i].name, style);
    const double x = std::clamp(points.back().x() + 0.7 * size_, 0.0,
                                std::max(0.0, map_width() - wide - 0.3 * size_));
    canvas.text(x, std::clamp(points.back().y() + 0.3 * size_, size_, map_height_ - 0.3 * size_),
                paths_[i].name, style);
  }

  /// A scale of 1, 2 or 5 times a power of ten metres, at most a third of the width.
  void draw_foot(Canvas& canvas) const {
    const double most_m = map_width() / 3.0 / raster_.pixels_per_m;
    double length_m = std::pow(10.0, std::floor(std::log10(most_m)));
    for (const double times : {5.0, 2.0}) {
      if (length_m * times <= most_m) {
        length_m *= times;
        break;
      }
    }
    const double length = length_m * raster_.pixels_per_m;
    const double top = map_y_ + map_height_ + 1.1 * size_, thick = 0.45 * size_;
    canvas.fill_rectangle(size_, top, length, thick, kInk);
    canvas.fill_rectangle(size_ + length / 2.0, top + 1.5, length / 2.0 - 1.5, thick - 3.0, kPage);
    canvas.text(2.0 * size_ + length - 0.4 * size_, top + 0.6 * size_,
                fmt::format("{:g} m", length_m), plain());
    const std::string explored = fmt::format("{:.0f} m² explored", explored_m2_);
    const Canvas::TextStyle style{size_, false, kFaintInk};
    canvas.text(width_ - size_ - canvas.text_width(explored, style), top + 0.6 * size_, explored,
                style);
  }

  PictureRaster raster_;
  const std::vector<PicturePath>& paths_;
  std::vector<LegendEntry> legend_;
  std::string title_;
  double explored_m2_ = 0.0;
  double size_ = 0.0;  ///< of the letters; everything else is measured by it
  double width_ = 0.0, height_ = 0.0, map_y_ = 0.0, map_height_ = 0.0;
  std::vector<std::vector<double>> rows_;  ///< left ends of the legend's entries
};

}  // namespace

Result<void> write_map_picture(const std::filesystem::path& file, const OccupancyGrid& grid,
                               const std::vector<PicturePath>& paths, const std::string& title,
                               DrawingFormat format) {
  const Sheet sheet(grid, paths, title);
  Canvas canvas(static_cast<int>(sheet.width()), static_cast<int>(sheet.height()), kPage, format);
  sheet.draw(canvas);
  const auto content = canvas.finish();
  if (!content) return fail(content.error().code, "{}: {}", file.string(), content.error().text);
  return write_file_atomically(file, *content);
}

double draw_map_picture(Canvas& canvas, const PictureFrame& frame, const OccupancyGrid& grid,
                        const std::vector<PicturePath>& paths, const std::string& title) {
  const Sheet sheet(grid, paths, title);
  const double times = std::min(frame.width / sheet.width(), frame.height / sheet.height());
  canvas.enter_scaled(frame.x, frame.y, frame.width, frame.height, times);
  sheet.draw(canvas);
  canvas.leave();
  return times * sheet.height();
}

}  // namespace lifeline::files
