#include "agents/sources/columns_source.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

#include "agents/sources/line_reader.hpp"
#include "agents/sources/scan_range.hpp"
#include "common/base/angles.hpp"

namespace lifeline::sources {
namespace {

using sensing::RawScan;

struct ColumnsOptions {
  ScanRange range;
  std::int64_t time = 0;    ///< column of the time, microseconds
  std::int64_t first = 24;  ///< column of the first range, millimetres
  std::int64_t beams = 682;
  std::int64_t mask = 70;  ///< beams on each side that see the device's own frame
  double fov_deg = 240.0;
  double min_range_m = 0.02;
  double max_range_m = 4.0;
};

Result<ColumnsOptions> read_columns_options(const SourceSpec& spec) {
  constexpr std::int64_t kMostColumns = 20'000;
  if (auto known = spec.allow_options(
          {"from", "to", "time", "first", "beams", "mask", "fov", "min_range", "max_range"});
      !known) {
    return forward_error(known);
  }
  ColumnsOptions options;
  const auto range = read_scan_range(spec);
  if (!range) return forward_error(range);
  options.range = *range;
  Result<void> status;
  const auto integer = [&](const char* name, std::int64_t& value, std::int64_t lowest) {
    const auto read = spec.integer(name, value, lowest, kMostColumns);
    if (read) value = *read;
    if (!read && status) status = forward_error(read);
  };
  const auto number = [&](const char* name, double& value, double lowest, double highest) {
    const auto read = spec.number(name, value, lowest, highest);
    if (read) value = *read;
    if (!read && status) status = forward_error(read);
  };
  integer("time", options.time, 0);
  integer("first", options.first, 0);
  integer("beams", options.beams, 1);
  integer("mask", options.mask, 0);
  number("fov", options.fov_deg, 1.0, 360.0);
  number("min_range", options.min_range_m, 0.0, 1000.0);
  number("max_range", options.max_range_m, 0.1, 1000.0);
  if (!status) return forward_error(status);
  if (2 * options.mask >= options.beams) {
    return fail(ErrorCode::wrong_use, "option mask={}: leaves none of {} beams", options.mask,
                options.beams);
  }
  return options;
}

class ColumnsSource final : public sensing::ScanSource {
 public:
  ColumnsSource(LineReader reader, const ColumnsOptions& options)
      : reader_(std::move(reader)), options_(options) {}

  Result<std::optional<RawScan>> next() override {
    if (ended_) return std::nullopt;
    auto scan = next_wanted();
    ended_ = !scan || !*scan;
    return scan;
  }

 private:
  Result<std::optional<RawScan>> next_wanted() {
    while (index_ < options_.range.to) {
      const auto line = reader_.next();
      if (!line) return forward_error(line);
      if (!*line) {
        const auto checked =
            check_scan_count(reader_.path(), index_, options_.range, "it has no lines");
        if (!checked) return forward_error(checked);
        return std::nullopt;
      }
      auto scan = convert((*line)->text);
      if (!scan) return forward_error(scan);
      if (index_++ >= options_.range.from) return *std::move(scan);
    }
    return std::nullopt;
  }

  Result<RawScan> convert(std::string_view text) const {
    RawScan scan;
    scan.angle_step_rad = options_.fov_deg / static_cast<double>(options_.beams) * kDegree;
    scan.first_angle_rad = -0.5 * options_.fov_deg * kDegree +
                           scan.angle_step_rad * static_cast<double>(options_.mask);
    scan.range_min_m = options_.min_range_m;
    scan.range_max_m = options_.max_range_m;
    const std::int64_t begin = options_.first + options_.mask;
    const std::int64_t end = options_.first + options_.beams - options_.mask;
    const std::int64_t needed = std::max(options_.first + options_.beams, options_.time + 1);
    for (std::int64_t column = 0; column < needed; ++column) {
      const auto field = take_field(text);
      if (field.empty()) return fail_here(fmt::format("{} columns, not {}", column, needed));
      const bool is_time = column == options_.time, is_range = column >= begin && column < end;
      if (!is_time && !is_range) continue;
      std::int64_t value = 0;
      const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
      if (error != std::errc{} || stop != field.data() + field.size() || value < 0 ||
          value > kMostValue) {
        return fail_here(fmt::format("column {}: '{}' is no whole number from 0 to {}", column,
                                     field.substr(0, 20), kMostValue));
      }
      if (is_time) scan.stamp = Timestamp(std::chrono::microseconds(value));
      if (is_range) scan.ranges_m.push_back(static_cast<float>(1e-3 * static_cast<double>(value)));
    }
    return scan;
  }

  /// The next column, taken off `text`; empty at the end of the line.
  static std::string_view take_field(std::string_view& text) {
    constexpr std::string_view kBlank = " \t\r,;";
    const auto begin = std::min(text.find_first_not_of(kBlank), text.size());
    const auto end = std::min(text.find_first_of(kBlank, begin), text.size());
    const auto field = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return field;
  }

  tl::unexpected<Error> fail_here(const std::string& what) const {
    return fail(ErrorCode::bad_data, "{}:{}: {}", reader_.path(), reader_.line_number(), what);
  }

  static constexpr std::int64_t kMostValue = 4'000'000'000'000'000;  // microseconds: 126 years

  LineReader reader_;
  ColumnsOptions options_;
  std::int64_t index_ = 0;  ///< of the next scan in the file
  bool ended_ = false;
};

}  // namespace

Result<std::unique_ptr<sensing::ScanSource>> open_columns_source(const SourceSpec& spec) {
  const auto options = read_columns_options(spec);
  if (!options) return forward_error(options);
  auto reader = LineReader::open(spec.target);
  if (!reader) return forward_error(reader);
  return std::make_unique<ColumnsSource>(*std::move(reader), *options);
}

}  // namespace lifeline::sources
