#include "tests/support/seeded_fleet.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <random>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/sharing/accept.hpp"
#include "coordinator/coordinator.hpp"
#include "tests/support/fleet_checker.hpp"
#include "tests/support/scripted_matches.hpp"
#include "tests/support/sharing_samples.hpp"
#include "tests/support/simulated_network.hpp"

namespace lifeline::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kTick = milliseconds(100);
constexpr Duration kTroubled = seconds(20);
constexpr Duration kQuiet = seconds(60);
constexpr const char* kCoordinator = "coordinator";
constexpr std::array kHelmets{"alpha", "bravo", "charlie", "delta"};

/// A helmet's sharing half; its mapper is the script.
struct Helmet {
  int life;
  LayerKey layer;
  sharing::HelmetSharing sharing;
};

class SeededFleet {
 public:
  explicit SeededFleet(std::uint64_t seed)
      : dice_(seed),
        cells_(static_cast<std::mt19937::result_type>(seed)),
        network_(~seed, clock_),
        coarse_(seed % 2 == 0),
        leaderless_(seed % 4 == 3),
        checker_(coarse_) {
    const std::size_t helmets = 2 + dice_.below(3);
    ids_.assign(kHelmets.begin(), kHelmets.begin() + static_cast<std::ptrdiff_t>(helmets));
    for (const std::string& id : ids_) start_helmet(id);
    start_coordinator();
  }

  SeedOutcome run() {
    for (Duration passed{}; passed < kTroubled; passed += kTick) {
      trouble();
      map();
      tick();
    }
    end_trouble();
    Duration quiet{};
    for (; quiet < kQuiet && !settled(); quiet += kTick) tick();
    check_at_rest();
    outcome_.violations = checker_.violations();
    outcome_.until_equal = quiet;
    outcome_.directives = newest_directive().epoch;
    return outcome_;
  }

 private:
  [[nodiscard]] sharing::Speaker speaker(const std::string& id) {
    return {AgentId::parse(id).value(), kMission, Incarnation{++outcome_.starts}};
  }
  [[nodiscard]] sharing::ExchangeChannels exchange(const std::string& id) {
    return {network_.writer<wire::TileRequest>(id), network_.reader<wire::TileRequest>(id),
            network_.writer<wire::TileCopy>(id), network_.reader<wire::TileCopy>(id)};
  }

  void start_helmet(const std::string& id) {
    const int life = ++lives_[id];
    const LayerKey layer{AgentId::parse(id).value(), MapId{static_cast<std::uint32_t>(life)},
                         Floor{0}};
    sharing::HelmetChannels channels{
        network_.writer<wire::HelmetPose>(id),
        network_.writer<wire::HelmetScan>(id),
        network_.writer<wire::TsdTile>(id),
        network_.writer<wire::AgentStatus>(id),
        network_.writer<wire::Detection>(id),
        network_.reader<wire::TsdTile>(id),
        network_.reader<wire::MergeDirective>(id),
        network_.reader<wire::AgentStatus>(id),
        network_.reader<wire::Detection>(id),
        exchange(id),
        {network_.writer<wire::DirectiveCopy>(id), network_.reader<wire::DirectiveCopy>(id)},
        [] { return std::uint64_t{0}; },
        [] { return std::uint64_t{0}; }};
    // Small tiles: some go because they differ for long, some because nothing more comes.
    const sharing::HoldBackConfig hold_back{milliseconds(500), 0.05, 0.1, 0.0};
    helmets_[id] = std::make_unique<Helmet>(
        Helmet{life,
               layer,
               {{speaker(id), layer, GridGeometry{}, {hold_back, coarse_}, 1e9},
                std::move(channels),
                clock_}});
    tell_state(*helmets_[id], wire::AgentState::tracking);
  }

  static void tell_state(Helmet& helmet, wire::AgentState what) {
    sharing::HelmetState state;
    state.state = what;
    helmet.sharing.put(std::move(state));
  }

  void start_coordinator() {
    ++lives_[kCoordinator];
    CoordinatorSettings settings{speaker(kCoordinator), GridGeometry{}, {}, {}};
    settings.schedule.min_explored_percent = 0.0;
    CoordinatorChannels channels{network_.reader<wire::TsdTile>(kCoordinator),
                                 network_.reader<wire::HelmetPose>(kCoordinator),
                                 network_.reader<wire::AgentStatus>(kCoordinator),
                                 network_.reader<wire::Detection>(kCoordinator),
                                 network_.writer<wire::MergeDirective>(kCoordinator),
                                 network_.writer<wire::MergeEvidence>(kCoordinator),
                                 network_.writer<wire::AgentStatus>(kCoordinator),
                                 exchange(kCoordinator),
                                 [] { return std::uint64_t{0}; },
                                 [] { return std::uint64_t{0}; }};
    coordinator_ =
        std::make_unique<Coordinator>(std::move(settings), std::move(channels), matches_, clock_);
  }

  void crash(const std::string& id) {
    network_.remove(id);
    if (id == kCoordinator) {
      coordinator_.reset();
      (void)matches_.take();
      return;
    }
    newest_.erase(helmets_.at(id)->layer);  // what had not left is lost with it
    helmets_.erase(id);
  }

  /// A mapper changed a tile or two.
  void map() {
    for (auto& [id, helmet] : helmets_) {
      if (!dice_.chance(0.05)) continue;
      const TileIndex tile{static_cast<std::int32_t>(dice_.below(2)),
                           static_cast<std::int32_t>(dice_.below(2))};
      const bool large = dice_.chance(0.02);  // more than one part
      const auto cells =
          std::make_shared<const QuantisedTile>(large ? random_tile(cells_) : small_tile(cells_));
      checker_.shown(helmet->layer, tile, *cells);
      newest_[helmet->layer][tile] = *cells;
      helmet->sharing.put({{tile, cells}});
    }
  }

  void trouble() {
    if (dice_.chance(0.01)) {
      LinkConditions link;
      link.loss = 0.1 * static_cast<double>(dice_.below(6));
      link.doubled = 0.05 * static_cast<double>(dice_.below(3));
      link.most_delay = dice_.between(milliseconds(5), milliseconds(800));
      network_.set_conditions(link);
    }
    if (dice_.chance(0.01)) part();
    if (dice_.chance(0.02)) network_.heal();
    if (dice_.chance(0.01)) matches_.spoil(dice_.chance(0.3));
    for (const std::string& id : ids_) {
      const bool alive = helmets_.contains(id);
      if (alive && helmets_.size() > 1 && dice_.chance(0.002)) crash(id);
      if (!alive && dice_.chance(0.01)) start_helmet(id);
    }
    if (coordinator_ && dice_.chance(0.003)) crash(kCoordinator);
    if (!coordinator_ && dice_.chance(0.03)) start_coordinator();
  }

  void part() {
    std::vector<std::set<std::string>> parts(2);
    for (const std::string& id : ids_) parts[dice_.below(2)].insert(id);
    parts[dice_.below(2)].insert(kCoordinator);
    network_.part(std::move(parts));
  }

  /// Helmets that crashed late stay away: others serve what they held of them.
  void end_trouble() {
    network_.heal();
    LinkConditions link;
    link.loss = 0.05;
    network_.set_conditions(link);
    matches_.spoil(false);
    if (!coordinator_ && !leaderless_) start_coordinator();
    if (coordinator_ && leaderless_) crash(kCoordinator);
    for (auto& [id, helmet] : helmets_) tell_state(*helmet, wire::AgentState::finished);
  }

  /// A coordinator that was started anew and has nothing to match says nothing: the helmets go on
  /// with what the one before it said last, and it shows no map.
  void check_at_rest() {
    auto machines = views();
    if (!coordinator_) return checker_.at_rest(machines, newest_directive(), newest_);
    const bool silent =
        coordinator_->directive().members.empty() && coordinator_->directive().epoch == said_.epoch;
    if (silent) machines.pop_back();
    checker_.at_rest(machines, silent ? followed() : coordinator_->directive(), newest_);
  }

  void tick() {
    clock_.advance(kTick);
    network_.deliver();
    for (auto& [id, helmet] : helmets_) {
      helmet->sharing.step();
      (void)helmet->sharing.take_peer_update();
    }
    if (coordinator_) coordinator_->step();
    if (coordinator_ && coordinator_->directive().epoch > said_.epoch) {
      said_ = coordinator_->directive();
    }
    for (const MachineView& machine : views()) checker_.look(machine);
  }

  [[nodiscard]] std::vector<MachineView> views() const {
    std::vector<MachineView> views;
    for (const auto& [id, helmet] : helmets_) {
      const auto& map = helmet->sharing.map();
      views.push_back({id, helmet->life, map.store(), map.epoch(), map.common_map()});
    }
    if (coordinator_) {
      views.push_back({kCoordinator, lives_.at(kCoordinator), coordinator_->store(),
                       Epoch{coordinator_->directive().epoch}, coordinator_->common_map()});
    }
    return views;
  }

  /// Of those that anybody alive knows.
  [[nodiscard]] const wire::MergeDirective& newest_directive() const {
    return coordinator_ ? coordinator_->directive() : followed();
  }
  /// The newest that a helmet follows; none where all of them began anew since.
  [[nodiscard]] const wire::MergeDirective& followed() const {
    const auto of = [](const auto& helmet) -> const wire::MergeDirective& {
      return helmet.second->sharing.map().directive();
    };
    return of(*std::ranges::max_element(
        helmets_, [&](const auto& a, const auto& b) { return sharing::outranks(of(b), of(a)); }));
  }
  /// Two coordinators may have written one of the same epoch.
  [[nodiscard]] bool all_follow(const wire::MergeDirective& directive) const {
    return std::ranges::all_of(helmets_, [&](const auto& helmet) {
      const auto& theirs = helmet.second->sharing.map().directive();
      return theirs.epoch == directive.epoch &&
             std::ranges::equal(theirs.members, directive.members,
                                [](const auto& a, const auto& b) {
                                  return a.layer == b.layer && a.group == b.group &&
                                         a.T_common_map == b.T_common_map;
                                });
    });
  }

  [[nodiscard]] bool settled() const {
    for (const auto& [id, helmet] : helmets_) {
      const bool placed = !helmet->sharing.map().common_map().placements().empty();
      if (helmet->sharing.tiles_behind() > 0 || (coordinator_ && !placed)) return false;
    }
    if (!all_follow(newest_directive())) return false;
    if (!coordinator_) return FleetChecker::all_equal(views(), Epoch{newest_directive().epoch});
    // Helmets keep following the last answer while a new coordinator still matches.
    return coordinator_->idle() && !coordinator_->directive().members.empty() &&
           FleetChecker::all_equal(views(), Epoch{coordinator_->directive().epoch});
  }

  Dice dice_;
  std::mt19937 cells_;
  ManualClock clock_;
  SimulatedNetwork network_;
  ScriptedMatches matches_{dice_};
  bool coarse_;      ///< every other fleet
  bool leaderless_;  ///< every fourth: the coordinator does not come back
  FleetChecker checker_;
  SeedOutcome outcome_;
  std::vector<std::string> ids_;
  std::map<std::string, int> lives_;
  std::map<std::string, std::unique_ptr<Helmet>> helmets_;
  std::unique_ptr<Coordinator> coordinator_;
  wire::MergeDirective said_;  ///< by any coordinator, the newest
  std::map<LayerKey, std::map<TileIndex, QuantisedTile>> newest_;  ///< of the living
};

}  // namespace

SeedOutcome run_seed(std::uint64_t seed) {
  return SeededFleet(seed).run();
}

}  // namespace lifeline::test
