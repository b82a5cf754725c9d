#include "agents/hud/window.hpp"

#include <algorithm>

#include <SDL.h>

namespace lifeline::hud {
namespace {

// More pixels than this a helmet's display is not drawn in: what is shown has no fine lines.
constexpr int kMostHeight = 720;
constexpr int kMostAcross = 4;  // times the height

tl::unexpected<Error> sdl_error(const char* what) {
  return fail(ErrorCode::unavailable, "HUD: {}: {}", what, SDL_GetError());
}

Size limited(Size size) {
  size.width = std::min(size.width, kMostAcross * size.height);
  if (size.height <= kMostHeight) return size;
  return {size.width * kMostHeight / size.height, kMostHeight};
}

}  // namespace

struct Window::Parts {
  SDL_Window* window = nullptr;
  SDL_Renderer* renderer = nullptr;
  SDL_Texture* texture = nullptr;

  Parts() = default;
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() {
    if (texture != nullptr) SDL_DestroyTexture(texture);
    if (renderer != nullptr) SDL_DestroyRenderer(renderer);
    if (window != nullptr) SDL_DestroyWindow(window);
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
  }
};

Result<int> find_key(const std::string& key) {
  const SDL_Keycode code = SDL_GetKeyFromName(key.c_str());
  if (code == SDLK_UNKNOWN)
    return fail(ErrorCode::wrong_use,
                "HUD: no key is called {}; give one as SDL does: Space, Return, F1, A", key);
  return code;
}

Window::Window(std::unique_ptr<Parts> parts, Size size, int key)
    : parts_(std::move(parts)), size_(size), key_(key) {}

Window::~Window() = default;

void Window::leave_thread() {
  SDL_TLSCleanup();
}

Result<std::unique_ptr<Window>> Window::open(std::optional<Size> size, const std::string& key) {
  const auto code = find_key(key);
  if (!code) return forward_error(code);
  // Signals are the program's.
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "0");
  if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) return sdl_error("no display");
  auto parts = std::make_unique<Parts>();
  const Size asked = size.value_or(Size{800, 480});
  parts->window =
      SDL_CreateWindow("Lifeline HUD", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, asked.width,
                       asked.height, size ? 0U : Uint32{SDL_WINDOW_FULLSCREEN_DESKTOP});
  if (parts->window == nullptr) return sdl_error("no window");
  if (!size) SDL_ShowCursor(SDL_DISABLE);
  Size given = asked;
  SDL_GetWindowSize(parts->window, &given.width, &given.height);
  given = limited({std::max(given.width, 1), std::max(given.height, 1)});
  parts->renderer = SDL_CreateRenderer(parts->window, -1, 0);
  if (parts->renderer == nullptr)
    parts->renderer = SDL_CreateRenderer(parts->window, -1, SDL_RENDERER_SOFTWARE);
  if (parts->renderer == nullptr) return sdl_error("nothing to draw with");
  parts->texture = SDL_CreateTexture(parts->renderer, SDL_PIXELFORMAT_ARGB8888,
                                     SDL_TEXTUREACCESS_STREAMING, given.width, given.height);
  if (parts->texture == nullptr) return sdl_error("no picture of this size");
  return std::unique_ptr<Window>(new Window(std::move(parts), given, *code));
}

Result<void> Window::show(std::span<const std::uint32_t> pixels) {
  const int row = size_.width * static_cast<int>(sizeof(std::uint32_t));
  if (SDL_UpdateTexture(parts_->texture, nullptr, pixels.data(), row) != 0 ||
      SDL_RenderCopy(parts_->renderer, parts_->texture, nullptr, nullptr) != 0) {
    return sdl_error("cannot show a picture");
  }
  SDL_RenderPresent(parts_->renderer);
  return {};
}

std::vector<WindowEvent> Window::take_events() {
  std::vector<WindowEvent> events;
  SDL_Event event;
  while (SDL_PollEvent(&event) != 0) {
    if (event.type == SDL_QUIT) events.push_back(WindowEvent::closed);
    const bool is_key = event.type == SDL_KEYDOWN || event.type == SDL_KEYUP;
    if (!is_key || event.key.keysym.sym != key_ || event.key.repeat != 0) continue;
    events.push_back(event.type == SDL_KEYDOWN ? WindowEvent::button_down : WindowEvent::button_up);
  }
  return events;
}

Result<std::vector<std::uint32_t>> Window::read_back() const {
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(size_.width) *
                                    static_cast<std::size_t>(size_.height));
  SDL_RenderCopy(parts_->renderer, parts_->texture, nullptr, nullptr);
  if (SDL_RenderReadPixels(parts_->renderer, nullptr, SDL_PIXELFORMAT_ARGB8888, pixels.data(),
                           size_.width * static_cast<int>(sizeof(std::uint32_t))) != 0) {
    return sdl_error("cannot read the picture back");
  }
  return pixels;
}

}  // namespace lifeline::hud
