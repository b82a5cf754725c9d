#include "common/files/nearest_name.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace lifeline::files {
namespace {

const std::vector<std::string> kNames{"cell_size_m", "truncation_m", "floor", "mission_id"};

TEST(NearestName, FindsAMistypedName) {
  EXPECT_EQ(nearest_name("flor", kNames), "floor");
  EXPECT_EQ(nearest_name("fl00r", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("cellsize_m", kNames), "cell_size_m");
  EXPECT_EQ(nearest_name("truncation", kNames), "truncation_m");
}

TEST(NearestName, FindsANameByAPartOfIt) {
  EXPECT_EQ(nearest_name("cell", kNames), "cell_size_m");
}

TEST(NearestName, SaysNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("colour", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("floor", {}), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(10'000, 'f'), kNames), std::nullopt);
}

}  // namespace
}  // namespace lifeline::files
