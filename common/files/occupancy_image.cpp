#include "common/files/occupancy_image.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include <yaml-cpp/yaml.h>

#include "common/files/atomic_file.hpp"
#include "common/files/grey_image.hpp"
#include "common/files/read_file.hpp"

namespace lifeline::files {
namespace {

constexpr std::uint8_t kFreeShade = 254, kOccupiedShade = 0, kUnknownShade = 205;

std::uint8_t shade_of(Occupancy cell) {
  if (cell == Occupancy::unknown) return kUnknownShade;
  return cell == Occupancy::free ? kFreeShade : kOccupiedShade;
}

/// What NAME.yaml says.
struct Description {
  std::string image;
  double resolution_m = 0.0;
  Eigen::Vector2d origin_m{0.0, 0.0};
  bool negate = false;
  bool scale = false;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
};

std::optional<double> to_number(const YAML::Node& node) {
  if (!node.IsScalar()) return std::nullopt;
  const std::string& text = node.Scalar();
  double number = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

/// Reads the description key by key; the first fault ends it.
class DescriptionReader {
 public:
  DescriptionReader(std::string file, const YAML::Node& root)
      : file_(std::move(file)), root_(root) {}

  Result<Description> read() {
    if (!root_.IsMap()) return fault(root_, "the file must hold image, resolution and origin");
    const YAML::Node image = root_["image"], resolution = root_["resolution"];
    if (!image || !image.IsScalar()) return fault(image, "image must name the image file");
    description_.image = image.Scalar();
    const auto cell = resolution ? to_number(resolution) : std::nullopt;
    if (!cell || *cell < 1e-3 || *cell > 100.0) {
      return fault(resolution, "resolution must be the side of a pixel, 0.001 to 100 m");
    }
    description_.resolution_m = *cell;
    if (const auto read = read_origin(root_["origin"]); !read) return forward_error(read);
    if (const auto read = read_mode(root_["mode"], root_["negate"]); !read) {
      return forward_error(read);
    }
    if (const auto read = read_thresholds(); !read) return forward_error(read);
    return description_;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> fault(const YAML::Node& node, const std::string& what) const {
    const YAML::Mark mark = node.IsDefined() ? node.Mark() : root_.Mark();
    return fail(ErrorCode::bad_data, "{}:{}:{}: {}", file_, mark.line + 1, mark.column + 1, what);
  }

  Result<void> read_origin(const YAML::Node& origin) {
    constexpr const char* kWhat = "origin must be [x, y, yaw] in m and rad, finite numbers";
    if (!origin || !origin.IsSequence() || origin.size() != 3) return fault(origin, kWhat);
    const auto x = to_number(origin[0]), y = to_number(origin[1]), yaw = to_number(origin[2]);
    constexpr double kFarthest_m = 1e6;
    if (!x || !y || !yaw || std::abs(*x) > kFarthest_m || std::abs(*y) > kFarthest_m) {
      return fault(origin, kWhat);
    }
    if (*yaw != 0.0) {
      return fault(origin[2], fmt::format("a map turned by {} rad cannot be read; export it with "
                                          "yaw 0",
                                          *yaw));
    }
    description_.origin_m = {*x, *y};
    return {};
  }

  Result<void> read_mode(const YAML::Node& mode, const YAML::Node& negate) {
    if (mode) {
      const std::string name = mode.IsScalar() ? mode.Scalar() : "";
      if (name != "trinary" && name != "scale") {
        return fault(mode, fmt::format("mode {} cannot be read; give trinary or scale", name));
      }
      description_.scale = name == "scale";
    }
    if (!negate) return {};
    const std::string text = negate.IsScalar() ? negate.Scalar() : "";
    if (text != "0" && text != "1" && text != "false" && text != "true") {
      return fault(negate, "negate must be 0 or 1");
    }
    description_.negate = text == "1" || text == "true";
    return {};
  }

  Result<void> read_thresholds() {
    for (const auto& [name, value] : {std::pair("occupied_thresh", &description_.occupied_thresh),
                                      std::pair("free_thresh", &description_.free_thresh)}) {
      const YAML::Node node = root_[name];
      if (!node) continue;
      const auto number = to_number(node);
      if (!number || *number < 0.0 || *number > 1.0) {
        return fault(node, fmt::format("{} must be a number from 0 to 1", name));
      }
      *value = *number;
    }
    if (description_.free_thresh >= description_.occupied_thresh) {
      return fault(root_["free_thresh"], "free_thresh must be less than occupied_thresh");
    }
    return {};
  }

  std::string file_;
  const YAML::Node root_;
  Description description_;
};

Result<Description> read_description(const std::filesystem::path& file) {
  constexpr std::size_t kMaxOctets = 1 << 20;
  const auto text = read_file(file, kMaxOctets);
  if (!text) return forward_error(text);
  try {
    return DescriptionReader(file.string(), YAML::Load(*text)).read();
  } catch (const YAML::Exception& error) {
    return fail(ErrorCode::bad_data, "{}:{}:{}: not valid YAML ({}); correct this line",
                file.string(), error.mark.line + 1, error.mark.column + 1, error.msg);
  }
}

OccupancyGrid to_grid(const GreyImage& image, const Description& description) {
  OccupancyGrid grid;
  grid.cell_size_m = description.resolution_m;
  grid.origin_m = description.origin_m;
  grid.columns = image.width;
  grid.rows = image.height;
  grid.cells.resize(image.shades.size(), Occupancy::unknown);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t pixel = grid.index(column, grid.rows - 1 - row);
      if (description.scale && !image.alphas.empty() && image.alphas[pixel] < 255) continue;
      const double shade = image.shades[pixel] / 255.0;
      const double occupied = description.negate ? shade : 1.0 - shade;
      auto& cell = grid.cells[grid.index(column, row)];
      if (occupied > description.occupied_thresh) cell = Occupancy::occupied;
      if (occupied < description.free_thresh) cell = Occupancy::free;
    }
  }
  return grid;
}

/// Row by row from above: the picture of a large map is as large as the map.
Result<void> write_pgm(const std::filesystem::path& name, const OccupancyGrid& grid) {
  auto file = AtomicFile::create(name);
  if (!file) return forward_error(file);
  std::string row = fmt::format("P5\n{} {}\n255\n", grid.columns, grid.rows);
  for (int above = grid.rows - 1; above >= 0; --above) {
    for (int column = 0; column < grid.columns; ++column) {
      row.push_back(static_cast<char>(shade_of(grid.at(column, above))));
    }
    if (const auto appended = file->append(row); !appended) return appended;
    row.clear();
  }
  return file->commit();
}

}  // namespace

Result<void> write_occupancy_image(const std::filesystem::path& name, const OccupancyGrid& grid) {
  const std::string image_file = name.string() + ".pgm";
  if (grid.columns <= 0 || grid.rows <= 0) {
    return fail(ErrorCode::wrong_use, "{}: the map is empty; nothing was written", image_file);
  }
  if (const auto written = write_pgm(image_file, grid); !written) return written;
  // The description last: where it stands, its image stands too.
  return write_file_atomically(
      name.string() + ".yaml",
      fmt::format(
          "image: {}.pgm\nmode: trinary\nresolution: {:.9f}\norigin: [{:.9f}, {:.9f}, 0.0]\n"
          "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
          name.filename().string(), grid.cell_size_m, grid.origin_m.x(), grid.origin_m.y()));
}

Result<OccupancyGrid> read_occupancy_image(const std::filesystem::path& yaml_file) {
  const auto description = read_description(yaml_file);
  if (!description) return forward_error(description);
  const auto image = read_grey_image(yaml_file.parent_path() / description->image);
  if (!image) return forward_error(image);
  return to_grid(*image, *description);
}

}  // namespace lifeline::files
