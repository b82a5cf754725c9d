#include "tests/bench/mission/map_delays.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

namespace lifeline::bench {
namespace {

using Tile = std::tuple<std::string, int, int>;  // whose, x, y

struct Published {
  Tile tile;
  std::uint64_t revision = 0;
  double scanned_at_s = 0.0, at_s = 0.0;
};

struct Fused {
  std::uint64_t revision = 0;
  double at_s = 0.0;
};

struct Journal {
  std::vector<Published> published;
  std::map<Tile, std::vector<Fused>> fused;
  std::map<std::string, double> first_fused_at_s;  ///< by whose tiles
  double last_line_at_s = 0.0;
};

Result<Journal> read(const std::string& helmet, const std::filesystem::path& file) {
  Journal journal;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const auto told = nlohmann::json::parse(line, nullptr, false);
    // A process that is ended leaves half a line.
    if (told.is_discarded() && lines.eof()) break;
    if (!told.is_object() || !told.contains("at_s"))
      return fail(ErrorCode::bad_data, "{}: no line of a journal: {}", file.string(), line);
    const double at_s = told["at_s"];
    journal.last_line_at_s = std::max(journal.last_line_at_s, at_s);
    if (told.contains("published")) {
      const auto& tile = told["published"];
      journal.published.push_back(
          {{helmet, tile[0], tile[1]}, told["revision"], told["scanned_at_s"], at_s});
    } else {
      const std::string of = told["of"];
      const auto& tile = told["fused"];
      journal.fused[{of, tile[0], tile[1]}].push_back({told["revision"], at_s});
      journal.first_fused_at_s.try_emplace(of, at_s);
    }
  }
  return journal;
}

/// When the tile was first in the common map at this revision or a newer one.
std::optional<double> fused_at_s(const Journal& journal, const Published& published) {
  const auto found = journal.fused.find(published.tile);
  if (found == journal.fused.end()) return std::nullopt;
  for (const Fused& fused : found->second) {
    if (fused.revision >= published.revision) return fused.at_s;
  }
  return std::nullopt;
}

/// From when on everybody shares with everybody; never: infinity.
double shared_from_s(const std::map<std::string, Journal>& journals) {
  double from_s = 0.0;
  for (const auto& [helmet, journal] : journals) {
    for (const auto& [of, other] : journals) {
      const auto first = journal.first_fused_at_s.find(of);
      if (first == journal.first_fused_at_s.end()) return std::numeric_limits<double>::infinity();
      from_s = std::max(from_s, first->second);
    }
  }
  return from_s;
}

void note(const Published& published, const std::map<std::string, Journal>& journals,
          MapDelays& delays) {
  double last_s = 0.0;
  for (const auto& [helmet, journal] : journals) {
    const auto at_s = fused_at_s(journal, published);
    if (!at_s) {
      ++delays.missing;
      return;
    }
    last_s = std::max(last_s, *at_s);
  }
  delays.seconds.push_back(last_s - published.scanned_at_s);
  delays.until_published_s.push_back(published.at_s - published.scanned_at_s);
  delays.until_fused_s.push_back(last_s - published.at_s);
}

}  // namespace

Result<MapDelays> map_delays(const std::map<std::string, std::filesystem::path>& files,
                             double before_end_s) {
  std::map<std::string, Journal> journals;
  double until_s = std::numeric_limits<double>::infinity();
  for (const auto& [helmet, file] : files) {
    auto journal = read(helmet, file);
    if (!journal) return forward_error(journal);
    until_s = std::min(until_s, journal->last_line_at_s - before_end_s);
    journals.emplace(helmet, *std::move(journal));
  }
  MapDelays delays;
  const double from_s = shared_from_s(journals);
  for (const auto& [helmet, journal] : journals) {
    for (const Published& published : journal.published) {
      if (published.at_s > from_s && published.at_s < until_s) note(published, journals, delays);
    }
  }
  return delays;
}

}  // namespace lifeline::bench
