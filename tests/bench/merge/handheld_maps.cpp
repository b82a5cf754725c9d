#include "tests/bench/merge/handheld_maps.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "common/files/grey_image.hpp"
#include "coordinator/matching/match_maps.hpp"
#include "tests/bench/merge/csv_rows.hpp"

namespace lifeline::bench {
namespace {

/// Corridors are 85 and offices 110 pixels wide: about 0.025 m a pixel. Two pixels make a cell.
constexpr double kPixel_m = 0.025;
constexpr int kPixelsPerCell = 2;
constexpr double kRight_m = 1.5, kRight_deg = 6.0;
constexpr double kWorstFit_m = 2.0;

/// A cell is occupied where one of its pixels is, free where one is free otherwise.
OccupancyGrid halve(const files::GreyImage& image) {
  OccupancyGrid grid;
  grid.cell_size_m = kPixel_m * kPixelsPerCell;
  grid.columns = (image.width + 1) / kPixelsPerCell;
  grid.rows = (image.height + 1) / kPixelsPerCell;
  grid.cells.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                    Occupancy::unknown);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int shade = image.shades[static_cast<std::size_t>(y * image.width + x)];
      Occupancy& cell =
          grid.cells[grid.index(x / kPixelsPerCell, (image.height - 1 - y) / kPixelsPerCell)];
      if (shade < 50) cell = Occupancy::occupied;
      if (shade > 200 && cell == Occupancy::unknown) cell = Occupancy::free;
    }
  }
  return grid;
}

class Site {
 public:
  explicit Site(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void write(Report& report) {
    for (const CsvRow& row : read_csv(folder_ / "alignments.csv")) match(row);
    const std::string name = "hand-held maps " + folder_.filename().string();
    const auto add = [&](const std::string& what, std::size_t count, std::optional<Bar> bar = {}) {
      report.rows.push_back({fmt::format("{}: {} of {}", name, what, pairs_),
                             static_cast<double>(count),
                             "",
                             bar,
                             {}});
    };
    add("merged wrongly", wrong_, Bar{Bar::Side::at_most, 0.0});
    add("merged rightly", right_);
    add("best place right", found_);
    add("best place right, and they wait because they are bent", bent_);
  }

 private:
  const matching::MapFeatures* features(const std::string& map) {
    if (const auto known = features_.find(map); known != features_.end()) return &known->second;
    const auto image = files::read_grey_image(folder_ / (map + ".png"));
    if (!image) return nullptr;
    auto built = matching::build_features(halve(*image));
    return built ? &features_.emplace(map, *std::move(built)).first->second : nullptr;
  }

  void match(const CsvRow& row) {
    const std::string &a = row.at("map_a"), &b = row.at("map_b");
    const bool drawn = b.find("layout") != std::string::npos;
    if (drawn || kPixel_m * number(row, "rigid_rms_px") > kWorstFit_m) return;
    const auto *features_a = features(a), *features_b = features(b);
    if (features_a == nullptr || features_b == nullptr) return;
    ++pairs_;
    const Pose2 T_b_a{kPixel_m * number(row, "rigid_tx_px"), kPixel_m * number(row, "rigid_ty_px"),
                      number(row, "rigid_rot_deg") * std::numbers::pi / 180.0};
    const auto result = matching::match_maps(*features_a, *features_b, {});
    const bool right = is_right(result, T_b_a.inverse());
    found_ += right ? 1U : 0U;
    bent_ += right && result.reason.find("bent") != std::string::npos ? 1U : 0U;
    if (result.accepted()) ++(right ? right_ : wrong_);
  }

  static bool is_right(const matching::MatchResult& result, const Pose2& T_a_b) {
    if (result.candidates.empty()) return false;
    const Pose2& found = result.candidates.front().T_a_b;
    const Eigen::Vector2d& p_b = result.overlap_centre_b_m;
    const double turn_deg =
        std::abs(normalise_angle(found.yaw_rad - T_a_b.yaw_rad)) * 180.0 / std::numbers::pi;
    return (found * p_b - T_a_b * p_b).norm() < kRight_m && turn_deg < kRight_deg;
  }

  std::filesystem::path folder_;
  std::map<std::string, matching::MapFeatures> features_;
  std::size_t pairs_ = 0, right_ = 0, wrong_ = 0, found_ = 0, bent_ = 0;
};

}  // namespace

void write_handheld_rows(const std::filesystem::path& folder, Report& report) {
  for (const char* site : {"E5", "HIH"}) {
    if (std::filesystem::exists(folder / site / "alignments.csv")) {
      Site(folder / site).write(report);
    }
  }
}

}  // namespace lifeline::bench
