#include "common/files/occupancy_image.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <png.h>

#include "common/files/grey_image.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::files {
namespace {

using ::testing::HasSubstr;

/// A grid as text, the upper row first: '#' occupied, '.' free, ' ' unknown.
std::string picture(const OccupancyGrid& grid) {
  std::string text;
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      text += " .#"[static_cast<int>(grid.at(column, row))];
    }
    text += '\n';
  }
  return text;
}

OccupancyGrid corner_grid() {
  OccupancyGrid grid;
  grid.cell_size_m = 0.05;
  grid.origin_m = {-1.25, 3.5};
  grid.columns = 3;
  grid.rows = 2;
  grid.cells = {Occupancy::free,     Occupancy::free,     Occupancy::unknown,
                Occupancy::occupied, Occupancy::occupied, Occupancy::free};
  return grid;
}

class OccupancyImage : public ::testing::Test {
 protected:
  std::string error_of(const std::string& yaml) {
    const auto read = read_occupancy_image(folder_.write("m.yaml", yaml));
    return read ? "read" : read.error().text;
  }
  /// A description with one of its lines replaced.
  static std::string with(const std::string& key, const std::string& line) {
    std::string text;
    for (const std::string own : {"image: m.pgm", "resolution: 0.05", "origin: [0, 0, 0]",
                                  "negate: 0", "occupied_thresh: 0.65", "free_thresh: 0.196"}) {
      text += (own.starts_with(key + ":") ? line : own) + "\n";
    }
    return text;
  }
  std::filesystem::path write_png(png_uint_32 format, std::vector<std::uint8_t> pixels, int width) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.format = format;
    png.width = static_cast<png_uint_32>(width);
    png.height =
        static_cast<png_uint_32>(pixels.size() / PNG_IMAGE_SAMPLE_CHANNELS(format)) / png.width;
    const auto file = folder_.path() / "m.png";
    EXPECT_NE(png_image_write_to_file(&png, file.c_str(), 0, pixels.data(), 0, nullptr), 0);
    return file;
  }
  support::TemporaryFolder folder_;
};

TEST_F(OccupancyImage, GivesAGridBack) {
  const OccupancyGrid grid = corner_grid();
  ASSERT_TRUE(write_occupancy_image(folder_.path() / "floor.1", grid));
  const auto read = read_occupancy_image(folder_.path() / "floor.1.yaml");
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_EQ(read->cells, grid.cells);
  EXPECT_EQ(read->columns, 3);
  EXPECT_EQ(read->cell_size_m, 0.05);
  EXPECT_EQ(read->origin_m, grid.origin_m);
}

TEST_F(OccupancyImage, WritesWhatMapServerWrites) {
  ASSERT_TRUE(write_occupancy_image(folder_.path() / "m", corner_grid()));
  // Row by row from above: the grid's upper row first.
  EXPECT_EQ(support::content_of(folder_.path() / "m.pgm"),
            std::string("P5\n3 2\n255\n") + std::string("\x00\x00\xfe\xfe\xfe\xcd", 6));
  EXPECT_EQ(support::content_of(folder_.path() / "m.yaml"),
            "image: m.pgm\nmode: trinary\nresolution: 0.050000000\n"
            "origin: [-1.250000000, 3.500000000, 0.0]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST_F(OccupancyImage, AnEmptyMapIsNotWritten) {
  EXPECT_THAT(write_occupancy_image(folder_.path() / "m", OccupancyGrid{}).error().text,
              HasSubstr("the map is empty"));
  EXPECT_EQ(folder_.files(), 0U);
}

TEST_F(OccupancyImage, ReadsTrinaryAndNegated) {
  (void)folder_.write("m.pgm",
                      std::string("P5\n# CREATOR: map_saver\n3 1\n255\n") + "\xfe\xcd\x10");
  EXPECT_EQ(picture(*read_occupancy_image(folder_.write("m.yaml", with("", "")))), ". #\n");
  EXPECT_EQ(picture(*read_occupancy_image(folder_.write("m.yaml", with("negate", "negate: 1")))),
            "##.\n");
}

TEST_F(OccupancyImage, ScaleHasStepsBetweenFreeAndOccupiedAndTransparency) {
  write_png(PNG_FORMAT_GA, {255, 255, 255, 100, 120, 255, 10, 255, 10, 0}, 5);
  const std::string yaml = with("image", "image: m.png");
  EXPECT_EQ(picture(*read_occupancy_image(folder_.write("s.yaml", yaml + "mode: scale\n"))),
            ".  # \n");
  EXPECT_EQ(picture(*read_occupancy_image(folder_.write("t.yaml", yaml))), ".. ##\n");
}

TEST_F(OccupancyImage, ReadsGreyAndColouredPng) {
  const std::string yaml = with("image", "image: m.png");
  write_png(PNG_FORMAT_GRAY, {255, 205, 0, 255}, 2);
  EXPECT_EQ(picture(*read_occupancy_image(folder_.write("m.yaml", yaml))), ". \n#.\n");
  write_png(PNG_FORMAT_RGB, {250, 250, 250, 30, 0, 60}, 2);
  EXPECT_EQ(picture(*read_occupancy_image(folder_.write("m.yaml", yaml))), ".#\n");
}

TEST_F(OccupancyImage, ReadsPgmWithFewerLevels) {
  (void)folder_.write("m.pgm", std::string("P5 2 1 15\n\x0f\x00", 12));
  EXPECT_EQ(picture(*read_occupancy_image(folder_.write("m.yaml", with("", "")))), ".#\n");
}

TEST_F(OccupancyImage, NamesAMissingImageOrDescription) {
  EXPECT_THAT(error_of(with("", "")), HasSubstr("m.pgm: no such file"));
  EXPECT_THAT(read_occupancy_image(folder_.path() / "none.yaml").error().text,
              HasSubstr("none.yaml: no such file"));
}

TEST_F(OccupancyImage, RefusesImagesThatEndTooEarly) {
  (void)folder_.write("m.pgm", "P5\n3 2\n255\nabcde");
  EXPECT_THAT(error_of(with("", "")), HasSubstr("m.pgm: ends after 5 of 6 pixels"));
  const auto png =
      support::content_of(write_png(PNG_FORMAT_GRAY, std::vector<std::uint8_t>(4096, 9), 64));
  for (const std::size_t kept : {std::size_t{10}, std::size_t{40}, png.size() - 20}) {
    (void)folder_.write("m.png", png.substr(0, kept));
    EXPECT_THAT(error_of(with("image", "image: m.png")), HasSubstr("m.png: broken PNG (")) << kept;
  }
}

TEST_F(OccupancyImage, RefusesLargeImagesBeforeTakingMemory) {
  (void)folder_.write("m.pgm", "P5\n20001 20001\n255\n");
  EXPECT_THAT(error_of(with("", "")), HasSubstr("20001 x 20001 pixels, at most 20000 a side"));
  (void)folder_.write("m.pgm", "P5\n4000000000 1\n255\n");
  EXPECT_THAT(error_of(with("", "")), HasSubstr("4000000000 x 1 pixels"));
  (void)folder_.write("m.pgm", "P5\n20000 20000\n255\n");
  EXPECT_THAT(error_of(with("", "")), HasSubstr("100000000 in all"));
}

TEST_F(OccupancyImage, RefusesOtherImages) {
  for (const std::string bad :
       {"P5\n", "P5\n-3 2\n255\n", "P5\n0 2\n255\n", "P5\n3 2\n65535\n", "P5 3"}) {
    (void)folder_.write("m.pgm", bad);
    EXPECT_THAT(error_of(with("", "")), HasSubstr("m.pgm: ")) << bad;
  }
  (void)folder_.write("m.pgm", "GIF89a");
  EXPECT_THAT(error_of(with("", "")), HasSubstr("neither a binary PGM (P5) nor a PNG"));
}

TEST_F(OccupancyImage, RefusesBrokenDescriptionsWithTheirPlace) {
  const auto fault = [&](const std::string& key, const std::string& line) {
    return error_of(with(key, line));
  };
  EXPECT_THAT(fault("origin", "origin: [.nan, 0, 0]"), HasSubstr("m.yaml:3:9: origin must be"));
  EXPECT_THAT(fault("origin", "origin: [nan, 0, 0]"), HasSubstr("finite numbers"));
  EXPECT_THAT(fault("origin", "origin: [1, 2]"), HasSubstr("origin must be"));
  EXPECT_THAT(fault("origin", ""), HasSubstr("origin must be"));
  EXPECT_THAT(
      fault("origin", "origin: [0, 0, 0.5]"),
      HasSubstr("m.yaml:3:16: a map turned by 0.5 rad cannot be read; export it with yaw 0"));
  EXPECT_THAT(fault("resolution", "resolution: 0"), HasSubstr("m.yaml:2:13: resolution must be"));
  EXPECT_THAT(fault("resolution", ""), HasSubstr("resolution must be"));
  EXPECT_THAT(fault("image", "image: [a, b]"), HasSubstr("image must name"));
  EXPECT_THAT(fault("image", ""), HasSubstr("image must name"));
  EXPECT_THAT(fault("negate", "negate: maybe"), HasSubstr("negate must be 0 or 1"));
  EXPECT_THAT(fault("negate", "mode: raw"), HasSubstr("mode raw cannot be read"));
  EXPECT_THAT(fault("free_thresh", "free_thresh: 2"), HasSubstr("free_thresh must be a number"));
  EXPECT_THAT(fault("free_thresh", "free_thresh: 0.7"), HasSubstr("less than occupied_thresh"));
  EXPECT_THAT(error_of("- a list"), HasSubstr("m.yaml:1:1: the file must hold"));
  EXPECT_THAT(error_of(""), HasSubstr("the file must hold"));
  EXPECT_THAT(error_of("image: [a"), HasSubstr("not valid YAML"));
}

TEST(OccupancyImageOfOthers, EveryTenthMapOfThePairsIsRead) {
  const std::filesystem::path pairs(LIFELINE_SOURCE_DIR "/../shared/data/mapmerge/pairs");
  if (!std::filesystem::exists(pairs)) GTEST_SKIP() << "needs " << pairs;
  int maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(pairs)) {
    if (entry.path().extension() != ".yaml" || ++maps % 10 != 0) continue;
    const auto read = read_occupancy_image(entry.path());
    ASSERT_TRUE(read) << read.error().text;
    EXPECT_GT(known_cells(*read), 10'000U) << entry.path();
    EXPECT_LT(known_cells(*read), read->cells.size()) << entry.path();
  }
  EXPECT_EQ(maps, 466);
}

}  // namespace
}  // namespace lifeline::files
