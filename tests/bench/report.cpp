#include "tests/bench/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "common/files/atomic_file.hpp"

namespace lifeline::bench {
namespace {

std::string value_text(const ReportRow& row) {
  const std::string number = std::isfinite(row.value) ? fmt::format("{:.4g}", row.value) : "-";
  return row.unit.empty() ? number : number + " " + row.unit;
}

std::string bar_text(const ReportRow& row) {
  return row.bar ? row.bar->text() : "";
}

}  // namespace

bool Bar::holds(double value) const {
  return side == Side::at_most ? value <= limit : value >= limit;
}

std::string Bar::text() const {
  return fmt::format("{} {:.4g}", side == Side::at_most ? "<=" : ">=", limit);
}

bool ReportRow::ok() const {
  return bar ? bar->holds(value) : !std::isnan(value);
}

bool Report::ok() const {
  return std::all_of(rows.begin(), rows.end(), [](const ReportRow& row) { return row.ok(); });
}

std::string describe_machine() {
  std::string processor = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      processor = line.substr(colon + 2);
      break;
    }
  }
  return fmt::format("{}, {} cores", processor, std::thread::hardware_concurrency());
}

std::string render(const Report& report) {
  std::size_t name_width = 4, value_width = 5, bar_width = 3;
  for (const ReportRow& row : report.rows) {
    name_width = std::max(name_width, row.name.size());
    value_width = std::max(value_width, value_text(row).size());
    bar_width = std::max(bar_width, bar_text(row).size());
  }
  std::string text = fmt::format("bench {}, {}\n", report.bench, report.machine);
  const auto add = [&](const std::string& name, const std::string& value, const std::string& bar,
                       const std::string& verdict, const std::string& reference) {
    std::string line = fmt::format("{:<{}}  {:>{}}  {:<{}}  {:<4}  {}", name, name_width, value,
                                   value_width, bar, bar_width, verdict, reference);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  add("what", "value", "bar", "", "others");
  std::size_t failed = 0;
  for (const ReportRow& row : report.rows) {
    failed += row.ok() ? 0 : 1;
    const char* verdict = row.ok() ? (row.bar ? "ok" : "") : "MISS";
    add(row.name, value_text(row), bar_text(row), verdict, row.reference);
  }
  return text + fmt::format("{} rows, {} missed\n", report.rows.size(), failed);
}

nlohmann::ordered_json to_json(const Report& report) {
  nlohmann::ordered_json json{{"bench", report.bench}, {"machine", report.machine}};
  json["rows"] = nlohmann::ordered_json::array();
  for (const ReportRow& row : report.rows) {
    nlohmann::ordered_json entry;
    entry["name"] = row.name;
    entry["value"] = nullptr;
    if (std::isfinite(row.value)) entry["value"] = row.value;
    entry["unit"] = row.unit;
    entry["bar"] = nullptr;
    if (row.bar) entry["bar"] = row.bar->text();
    entry["reference"] = row.reference;
    entry["ok"] = row.ok();
    json["rows"].push_back(std::move(entry));
  }
  return json;
}

int finish(const Report& report, const std::optional<std::filesystem::path>& out) {
  fmt::print("{}", render(report));
  std::fflush(stdout);
  if (out) {
    const auto written = files::write_file_atomically(*out, to_json(report).dump(1) + "\n");
    if (!written) {
      fmt::print(stderr, "lifeline bench: {}\n", written.error().text);
      return 1;
    }
  }
  return report.ok() ? 0 : 1;
}

}  // namespace lifeline::bench
