#include "agents/hud/hud.hpp"

#include <fstream>
#include <utility>

#include "agents/hud/draw_hud.hpp"
#include "common/base/log.hpp"

namespace lifeline::hud {
namespace {

constexpr Duration kFrame = std::chrono::nanoseconds(1'000'000'000 / 30);
// Without a display: for the button alone.
constexpr Duration kBlindFrame = std::chrono::milliseconds(50);
constexpr Duration kPngInterval = std::chrono::seconds(1);
constexpr Duration kLookForDisplay = std::chrono::seconds(5);
constexpr Size kUsualSize{800, 480};
constexpr std::size_t kMostCommands = 16;

/// Readers find the old picture or the new one. Not flushed to the disk: a picture a second would
/// wear out a card, and nobody needs it after a crash.
bool replace_file(const std::filesystem::path& file, const std::string& content) {
  auto part = file;
  part += ".part";
  {
    std::ofstream stream(part, std::ios::binary | std::ios::trunc);
    if (!stream.write(content.data(), static_cast<std::streamsize>(content.size())).flush())
      return false;
  }
  std::error_code failed;
  std::filesystem::rename(part, file, failed);
  return !failed;
}

}  // namespace

Result<std::unique_ptr<Hud>> Hud::start(const HudOptions& options, double cell_size_m,
                                        const Path& earlier) {
  if (options.png &&
      !std::filesystem::is_directory(std::filesystem::absolute(*options.png).parent_path())) {
    return fail(ErrorCode::not_found, "--hud-png {}: there is no such folder",
                options.png->string());
  }
  if (auto key = find_key(options.key); !key) return forward_error(key);
  std::optional<ButtonPipe> button;
  if (options.button) {
    auto opened = ButtonPipe::open(*options.button);
    if (!opened) return forward_error(opened);
    button = *std::move(opened);
  }
  return std::unique_ptr<Hud>(new Hud(options, std::move(button), cell_size_m, earlier));
}

Hud::Hud(HudOptions options, std::optional<ButtonPipe> button, double cell_size_m,
         const Path& earlier)
    : options_(std::move(options)),
      core_(cell_size_m, earlier),
      button_(std::move(button)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Hud::~Hud() = default;

void Hud::put(const sharing::MapTiles& own) {
  std::lock_guard lock(mutex_);
  for (const auto& [tile, cells] : own) own_[tile] = cells;
}

void Hud::put(const sharing::PeerUpdate& peers) {
  std::lock_guard lock(mutex_);
  for (const auto& [tile, cells] : peers.tiles) peers_[tile] = cells;
}

void Hud::put(HudFacts facts) {
  std::lock_guard lock(mutex_);
  facts_ = std::move(facts);
}

std::vector<HudCommand> Hud::take_commands() {
  std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}

void Hud::run(const std::stop_token& stop) {
  SteadyTime next = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    const SteadyTime now = std::chrono::steady_clock::now();
    take_in(now);
    find_display(now);
    hear_buttons(now);
    draw(core_.step(now), now);
    // After a late frame the next one comes a frame later, not at once.
    next = std::max(next + (window_ ? kFrame : kBlindFrame), now);
    std::unique_lock lock(mutex_);
    for (auto& command : core_.take_commands()) {
      if (commands_.size() < kMostCommands) commands_.push_back(std::move(command));
    }
    wake_.wait_until(lock, stop, next, [] { return false; });
  }
  window_.reset();  // by the thread that opened it
  Window::leave_thread();
}

void Hud::take_in(SteadyTime now) {
  sharing::MapTiles own;
  sharing::PeerUpdate peers;
  std::optional<HudFacts> facts;
  {
    std::lock_guard lock(mutex_);
    own.assign(own_.begin(), own_.end());
    peers.tiles.assign(peers_.begin(), peers_.end());
    facts = std::exchange(facts_, std::nullopt);
    own_.clear();
    peers_.clear();
  }
  if (!own.empty()) core_.put(own);
  if (!peers.tiles.empty()) core_.put(peers);
  if (facts) core_.put(*std::move(facts), now);
}

void Hud::find_display(SteadyTime now) {
  if (!options_.display || window_ || closed_ || now < display_due_) return;
  display_due_ = now + kLookForDisplay;
  auto opened = Window::open(options_.size, options_.key);
  if (opened) {
    window_ = *std::move(opened);
    pen_.reset();
    const Size size = window_->picture_size();
    spdlog::info("HUD on the display, {} x {}", size.width, size.height);
  } else if (!std::exchange(told_no_display_, true)) {
    spdlog::error("{}; the helmet goes on without, and looks for one every 5 s",
                  opened.error().text);
  }
}

void Hud::hear_buttons(SteadyTime now) {
  if (button_) {
    for (const bool down : button_->take()) core_.set_button(down, now);
  }
  if (!window_) return;
  for (const WindowEvent event : window_->take_events()) {
    if (event == WindowEvent::closed) {
      spdlog::info("the HUD's window was closed; the helmet goes on");
      window_.reset();
      closed_ = true;
      return;
    }
    core_.set_button(event == WindowEvent::button_down, now);
  }
}

void Hud::draw(const HudPicture& picture, SteadyTime now) {
  const bool wants_png = options_.png && now >= png_due_;
  if (!window_ && !wants_png) return;
  if (!pen_) {
    const Size size = window_ ? window_->picture_size() : options_.size.value_or(kUsualSize);
    pen_ = std::make_unique<Pen>(size.width, size.height);
  }
  draw_hud(picture, core_.map(), *pen_);
  if (window_) {
    ++pictures_shown_;
    if (auto shown = window_->show(pen_->pixels()); !shown) {
      spdlog::error("{}", shown.error().text);
      window_.reset();
    }
  }
  if (!wants_png) return;
  png_due_ = now + kPngInterval;
  write_png();
}

void Hud::write_png() {
  const auto png = pen_->png();
  const bool written = png && replace_file(*options_.png, *png);
  if (!written && !std::exchange(told_no_png_, true)) {
    spdlog::warn("{}: the HUD's picture cannot be written; tried again each second",
                 options_.png->string());
  }
  if (written) told_no_png_ = false;
}

}  // namespace lifeline::hud
