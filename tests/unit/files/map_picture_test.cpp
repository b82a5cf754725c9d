#include "common/files/map_picture.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <png.h>

#include "common/files/picture_raster.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::files {
namespace {

using ::testing::HasSubstr;

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  [[nodiscard]] std::size_t count(std::uint32_t colour) const {
    std::size_t found = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
      found +=
          colour == (std::uint32_t{rgb[i]} << 16U | std::uint32_t{rgb[i + 1]} << 8U | rgb[i + 2]);
    }
    return found;
  }
};

constexpr std::uint32_t kWall = 0x1f2a37, kFloor = 0xffffff, kBlue = 0x0072b2, kOrange = 0xe69f00;

/// A room of free cells with walls about it, some unknown around.
OccupancyGrid room(int columns, int rows, double cell_size_m = 0.05) {
  OccupancyGrid grid;
  grid.cell_size_m = cell_size_m;
  grid.origin_m = {-2.0, 1.0};
  grid.columns = columns + 20;
  grid.rows = rows + 20;
  grid.cells.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                    Occupancy::unknown);
  for (int row = 10; row < 10 + rows; ++row) {
    for (int column = 10; column < 10 + columns; ++column) {
      const bool wall = row == 10 || column == 10 || row == 9 + rows || column == 9 + columns;
      grid.cells[grid.index(column, row)] = wall ? Occupancy::occupied : Occupancy::free;
    }
  }
  return grid;
}

class MapPicture : public ::testing::Test {
 protected:
  Picture drawn(const OccupancyGrid& grid, const std::vector<PicturePath>& paths,
                const std::string& title = "A room") {
    const auto file = folder_.path() / "m.png";
    const auto written = write_map_picture(file, grid, paths, title);
    EXPECT_TRUE(written) << written.error().text;
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&png, file.c_str()), 0);
    png.format = PNG_FORMAT_RGB;
    Picture picture{static_cast<int>(png.width), static_cast<int>(png.height), {}};
    picture.rgb.resize(PNG_IMAGE_SIZE(png));
    EXPECT_NE(png_image_finish_read(&png, nullptr, picture.rgb.data(), 0, nullptr), 0);
    return picture;
  }
  support::TemporaryFolder folder_;
};

TEST_F(MapPicture, ShowsFloorWallsAndEachPathInItsColour) {
  const Picture picture = drawn(
      room(200, 100), {{"alpha", {{0.0, 3.0}, {5.0, 3.0}}}, {"bravo", {{0.0, 4.0}, {5.0, 5.0}}}});
  EXPECT_GT(picture.count(kFloor), 200U * 100U);
  EXPECT_GT(picture.count(kWall), 600U);
  EXPECT_GT(picture.count(kBlue), 500U);
  EXPECT_GT(picture.count(kOrange), 500U);
}

TEST_F(MapPicture, APathKeepsTheColourItWasGiven) {
  const Picture picture = drawn(room(200, 100), {{"bravo", {{0.0, 3.0}, {5.0, 3.0}}, 1}});
  EXPECT_EQ(picture.count(kBlue), 0U);
  EXPECT_GT(picture.count(kOrange), 500U);
}

TEST_F(MapPicture, SidesStayWithinTheirBounds) {
  for (const auto& [columns, rows] :
       {std::pair(3, 3), std::pair(4000, 5), std::pair(5, 9000), std::pair(400, 400)}) {
    const Picture picture = drawn(room(columns, rows), {});
    EXPECT_GE(std::min(picture.width, picture.height), 400) << columns << " x " << rows;
    EXPECT_LE(std::max(picture.width, picture.height), 4000) << columns << " x " << rows;
  }
}

TEST_F(MapPicture, AnEmptyMapIsAPictureToo) {
  const Picture picture = drawn(OccupancyGrid{}, {{"alpha", {}}});
  EXPECT_EQ(picture.width, 400);
}

TEST_F(MapPicture, StrangePathsTextsAndManyHelmetsAreDrawn) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<PicturePath> paths{{"", {{kNan, 1.0}, {1e300, 0.0}, {0.0, 3.0}}},
                                 {std::string(300, 'x'), {{1e5, -1e5}}},
                                 {"Müller", {{0.0, 3.0}}}};
  for (int i = 0; i < 60; ++i) paths.push_back({"helmet" + std::to_string(i), {{0.1 * i, 3.0}}});
  const Picture picture = drawn(room(200, 100), paths, std::string(500, 'W') + " ü");
  EXPECT_LE(std::max(picture.width, picture.height), 4000);
}

TEST_F(MapPicture, AFolderThatCannotBeWrittenIsNamed) {
  const auto written =
      write_map_picture(folder_.path() / "no" / "m.png", room(20, 20), {}, "A room");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().text, HasSubstr("no/m.png: cannot be written"));
}

TEST(PictureRaster, ACellIsASquareOfPixelsWithNorthUp) {
  const PictureRaster raster = to_picture_raster(room(30, 20), 400, 3000);
  ASSERT_EQ(raster.width_px, (30 + 20) * 8);
  ASSERT_EQ(raster.height_px, (20 + 20) * 8);
  // The room's lower left cell begins at (-1.5, 1.5).
  const Eigen::Vector2d corner = raster.to_pixel({-1.5, 1.5});
  EXPECT_NEAR(corner.x(), 10 * 8, 1e-6);
  EXPECT_NEAR(corner.y(), 30 * 8, 1e-6);
  const auto at = [&](double x_m, double y_m) {
    const Eigen::Vector2d pixel = raster.to_pixel({x_m, y_m});
    return raster
        .pixels[static_cast<std::size_t>(pixel.y()) * static_cast<std::size_t>(raster.width_px) +
                static_cast<std::size_t>(pixel.x())];
  };
  EXPECT_EQ(at(-1.49, 1.51), Occupancy::occupied);
  EXPECT_EQ(at(-1.44, 1.56), Occupancy::free);
  EXPECT_EQ(at(-1.51, 1.51), Occupancy::unknown);
}

TEST(PictureRaster, AThinWallShowsHoweverManyCellsShareAPixel) {
  OccupancyGrid grid = room(2000, 1000);
  for (int row = 11; row < 1009; ++row) grid.cells[grid.index(777, row)] = Occupancy::occupied;
  const PictureRaster raster = to_picture_raster(grid, 300, 300);
  EXPECT_LE(raster.width_px, 300);
  const Eigen::Vector2d pixel = raster.to_pixel({-2.0 + 777.5 * 0.05, 1.0 + 500.0 * 0.05});
  EXPECT_EQ(
      raster
          .pixels[static_cast<std::size_t>(pixel.y()) * static_cast<std::size_t>(raster.width_px) +
                  static_cast<std::size_t>(pixel.x())],
      Occupancy::occupied);
}

}  // namespace
}  // namespace lifeline::files
