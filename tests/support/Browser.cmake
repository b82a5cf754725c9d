# A real browser for tests and benchmarks: Debian's Chromium, driven by npm packages that are fetched when something that
# needs them is built (target lifeline_browser_packages, folder LIFELINE_BROWSER_PACKAGES).
include_guard(GLOBAL)
find_program(LIFELINE_CHROMIUM NAMES chromium chromium-browser google-chrome)
find_program(LIFELINE_NODE node)
find_program(LIFELINE_NPM npm)
if(NOT LIFELINE_CHROMIUM OR NOT LIFELINE_NODE OR NOT LIFELINE_NPM)
  message(FATAL_ERROR "the dashboard's tests need chromium, node and npm: run ./lifeline setup")
endif()
set(LIFELINE_BROWSER_PACKAGES "${PROJECT_BINARY_DIR}/browser" CACHE INTERNAL "")
set(browser_source "${PROJECT_SOURCE_DIR}/tests/support/browser")
add_custom_command(OUTPUT "${LIFELINE_BROWSER_PACKAGES}/packages.stamp"
  COMMAND bash "${browser_source}/fetch_packages.sh" "${browser_source}" "${LIFELINE_BROWSER_PACKAGES}"
  DEPENDS "${browser_source}/package.json" "${browser_source}/package-lock.json" "${browser_source}/fetch_packages.sh"
  VERBATIM COMMENT "Fetching the browser tests' npm packages")
add_custom_target(lifeline_browser_packages DEPENDS "${LIFELINE_BROWSER_PACKAGES}/packages.stamp")
