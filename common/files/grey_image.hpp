#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::files {

/// An image as shades of grey.
struct GreyImage {
  static constexpr int kMaxSide = 20'000;
  static constexpr std::size_t kMaxPixels = 100'000'000;

  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> shades;  ///< 0 = black, 255 = white; row by row from above
  std::vector<std::uint8_t> alphas;  ///< 255 = opaque; empty where the file holds none
};

/// Reads a binary PGM (P5, up to 255 levels) or any PNG; colours become the mean of red, green and
/// blue. Sides and pixels beyond the limits are refused before memory is taken for them; an image
/// that ends too early is refused whole.
[[nodiscard]] Result<GreyImage> read_grey_image(const std::filesystem::path& file);

}  // namespace lifeline::files
