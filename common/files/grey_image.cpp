#include "common/files/grey_image.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include <png.h>

#include "common/files/read_file.hpp"

namespace lifeline::files {
namespace {

Result<void> check_size(const std::string& name, std::uint64_t width, std::uint64_t height) {
  if (width == 0 || height == 0) {
    return fail(ErrorCode::bad_data, "{}: an image without pixels; export it again", name);
  }
  if (width > GreyImage::kMaxSide || height > GreyImage::kMaxSide ||
      width * height > GreyImage::kMaxPixels) {
    return fail(ErrorCode::unsupported,
                "{}: {} x {} pixels, at most {} a side and {} in all are read; cut or scale it",
                name, width, height, GreyImage::kMaxSide, GreyImage::kMaxPixels);
  }
  return {};
}

/// Takes the next number of a PGM header off `rest`, past blanks and comments.
std::optional<std::uint32_t> next_number(std::string_view& rest) {
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
    if (!rest.starts_with('#')) break;
    rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
  }
  std::uint32_t number = 0;
  const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc{}) return std::nullopt;
  rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
  return number;
}

Result<GreyImage> decode_pgm(const std::string& name, std::string_view content) {
  std::string_view rest = content.substr(2);
  const auto width = next_number(rest), height = next_number(rest), levels = next_number(rest);
  if (!width || !height || !levels || *levels == 0 || *levels > 255 || rest.empty()) {
    return fail(ErrorCode::bad_data, "{}: no PGM header with width, height and up to 255 levels",
                name);
  }
  if (const auto checked = check_size(name, *width, *height); !checked) {
    return forward_error(checked);
  }
  rest.remove_prefix(1);  // one blank ends the header
  const std::size_t pixels = std::size_t{*width} * *height;
  if (rest.size() < pixels) {
    return fail(ErrorCode::bad_data, "{}: ends after {} of {} pixels; copy it again", name,
                rest.size(), pixels);
  }
  GreyImage image{static_cast<int>(*width), static_cast<int>(*height), {}, {}};
  image.shades.resize(pixels);
  std::transform(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(pixels),
                 image.shades.begin(), [&](char octet) {
                   const std::uint32_t level = static_cast<unsigned char>(octet);
                   return static_cast<std::uint8_t>(std::min(level, *levels) * 255 / *levels);
                 });
  return image;
}

Result<GreyImage> decode_png(const std::string& name, std::string_view content) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto broken = [&] {
    const std::string why(png.message);
    png_image_free(&png);
    return fail(ErrorCode::bad_data, "{}: broken PNG ({}); copy it again", name, why);
  };
  if (png_image_begin_read_from_memory(&png, content.data(), content.size()) == 0) return broken();
  if (const auto checked = check_size(name, png.width, png.height); !checked) {
    png_image_free(&png);
    return forward_error(checked);
  }
  const bool has_alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> colours(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, colours.data(), 0, nullptr) == 0) return broken();
  GreyImage image{static_cast<int>(png.width), static_cast<int>(png.height), {}, {}};
  image.shades.resize(colours.size() / 4);
  if (has_alpha) image.alphas.resize(image.shades.size());
  for (std::size_t i = 0; i < image.shades.size(); ++i) {
    const int sum = colours[4 * i] + colours[4 * i + 1] + colours[4 * i + 2];
    image.shades[i] = static_cast<std::uint8_t>(sum / 3);
    if (has_alpha) image.alphas[i] = colours[4 * i + 3];
  }
  return image;
}

}  // namespace

Result<GreyImage> read_grey_image(const std::filesystem::path& file) {
  constexpr std::size_t kMaxOctets = std::size_t{512} << 20;
  const auto content = read_file(file, kMaxOctets);
  if (!content) return forward_error(content);
  if (content->starts_with("P5")) return decode_pgm(file.string(), *content);
  if (content->starts_with("\x89PNG")) return decode_png(file.string(), *content);
  return fail(ErrorCode::unsupported, "{}: neither a binary PGM (P5) nor a PNG; convert it",
              file.string());
}

}  // namespace lifeline::files
