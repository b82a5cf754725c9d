# How every library, program and test of the project is declared.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Code built from IDL and Protobuf changes with the tool that made it: kept out of the source tree.
set(LIFELINE_GENERATED_DIR "${PROJECT_BINARY_DIR}/generated")

# Fused multiply-add would make results differ between machines; the maps must not.
add_compile_options(-ffp-contract=off)

find_program(LIFELINE_CCACHE ccache)
if(LIFELINE_CCACHE)
  # Without these two, ccache keeps nothing of a source that a precompiled header is used for. No source of ours tells the
  # time of its compilation.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_SLOPPINESS=pch_defines,time_macros" "${LIFELINE_CCACHE}")
endif()
find_program(LIFELINE_MOLD mold)
if(LIFELINE_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

function(lifeline_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  if(LIFELINE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# Sources of a target in batches: headers are parsed, and what they inline is compiled, once a batch. A source that forgets
# an include shows only where it is compiled alone: `single` does so.
function(lifeline_batch target)
  if(LIFELINE_BATCHES)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()

# lifeline_precompile_headers(NAME [FLAGS f...] [LINK libs...] [HEADERS h...]): headers of others that most sources include,
# parsed once for all targets whose flags are alike; like batches, these hide an include that is forgotten.
function(lifeline_precompile_headers name)
  cmake_parse_arguments(arg "" "" "FLAGS;LINK;HEADERS" ${ARGN})
  set(source "${PROJECT_BINARY_DIR}/precompiled/${name}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "// A target needs a source.\n")
  add_library(${name} OBJECT "${source}")
  target_compile_options(${name} PRIVATE ${arg_FLAGS} ${LIFELINE_PRECOMPILED_OPTIONS})
  lifeline_warnings(${name})  # -Wpedantic defines a macro less
  target_link_libraries(${name} PRIVATE Eigen3::Eigen nlohmann_json::nlohmann_json spdlog::spdlog tl::expected Threads::Threads ${arg_LINK})
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <cstdint> <deque> <filesystem> <fstream> <functional> <limits> <map>
    <memory> <mutex> <numbers> <numeric> <optional> <random> <set> <span> <sstream> <stop_token> <string> <string_view> <thread>
    <unordered_map> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp>
    <spdlog/spdlog.h> <tl/expected.hpp> ${arg_HEADERS})
endfunction()

if(LIFELINE_BATCHES)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(LIFELINE_PRECOMPILED_OPTIONS -fpch-preprocess)
  else()
    # Clang would refuse a header that was compiled with fewer -D than the source; GCC looks whether any of them matters.
    set(LIFELINE_PRECOMPILED_OPTIONS "SHELL:-Xclang -fno-validate-pch" "SHELL:-Xclang -fno-pch-timestamp" -fpch-instantiate-templates)
  endif()
  set(LIFELINE_PRECOMPILED lifeline_precompiled)
  set(LIFELINE_COMPUTING_PRECOMPILED lifeline_precompiled)
  set(LIFELINE_TEST_PRECOMPILED lifeline_test_precompiled)
  lifeline_precompile_headers(${LIFELINE_PRECOMPILED})
  if(LIFELINE_COMPUTING_FLAGS)
    set(LIFELINE_COMPUTING_PRECOMPILED lifeline_computing_precompiled)
    lifeline_precompile_headers(${LIFELINE_COMPUTING_PRECOMPILED} FLAGS ${LIFELINE_COMPUTING_FLAGS})
  endif()
  if(LIFELINE_TESTS)
    lifeline_precompile_headers(${LIFELINE_TEST_PRECOMPILED} FLAGS ${LIFELINE_TEST_FLAGS}
      LINK GTest::gmock HEADERS <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Two compilers fit in memory with all that they would clear away between times: a tenth of their time.
    add_compile_options(--param ggc-min-heapsize=1500000)
  endif()
endif()

# `precompiled`: one of the above, or nothing. A target of C sources is left as it is.
function(lifeline_use_precompiled target precompiled)
  get_target_property(sources ${target} SOURCES)
  if(precompiled AND NOT sources MATCHES "\\.c(;|$)")
    target_precompile_headers(${target} REUSE_FROM ${precompiled})
    target_compile_options(${target} PRIVATE ${LIFELINE_PRECOMPILED_OPTIONS})
    target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:${precompiled},COMPILE_DEFINITIONS>)
  endif()
endfunction()

# lifeline_library(NAME [COMPUTES] SOURCES a.cpp ... [PUBLIC libs...] [PRIVATE libs...]): target lifeline_NAME, alias
# lifeline::NAME. COMPUTES: tests wait for its arithmetic, so that it is optimised even where the rest is not.
function(lifeline_library name)
  cmake_parse_arguments(arg "COMPUTES" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(lifeline_${name} STATIC ${arg_SOURCES})
  add_library(lifeline::${name} ALIAS lifeline_${name})
  target_include_directories(lifeline_${name} PUBLIC "${PROJECT_SOURCE_DIR}")
  target_link_libraries(lifeline_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  lifeline_warnings(lifeline_${name})
  lifeline_batch(lifeline_${name})
  if(arg_COMPUTES)
    target_compile_options(lifeline_${name} PRIVATE ${LIFELINE_COMPUTING_FLAGS})
    lifeline_use_precompiled(lifeline_${name} "${LIFELINE_COMPUTING_PRECOMPILED}")
  else()
    lifeline_use_precompiled(lifeline_${name} "${LIFELINE_PRECOMPILED}")
  endif()
endfunction()

# lifeline_program(NAME SOURCES a.cpp ... LINK libs...): program NAME in build/<preset>/bin.
function(lifeline_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_LINK})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
  lifeline_warnings(${name})
  lifeline_batch(${name})
  lifeline_use_precompiled(${name} "${LIFELINE_PRECOMPILED}")
endfunction()

function(lifeline_add_to_group group name)
  if(NOT TARGET ${group})
    add_custom_target(${group})
  endif()
  add_dependencies(${group} ${name})
endfunction()

# lifeline_test(NAME LINK libs... [LABELS l...] [SOURCES ...]): one GoogleTest program of the calling folder's *_test.cpp
# files (or SOURCES), each test registered with CTest under its own name.
function(lifeline_test name)
  if(NOT LIFELINE_TESTS)
    return()
  endif()
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LINK;LABELS" ${ARGN})
  if(NOT arg_SOURCES)
    file(GLOB arg_SOURCES CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_LINK} GTest::gmock_main)
  target_compile_definitions(${name} PRIVATE
    LIFELINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LIFELINE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  lifeline_warnings(${name})
  lifeline_batch(${name})
  target_compile_options(${name} PRIVATE ${LIFELINE_TEST_FLAGS})
  lifeline_use_precompiled(${name} "${LIFELINE_TEST_PRECOMPILED}")
  if(threads IN_LIST arg_LABELS)  # the ones that the thread sanitizer build is for
    lifeline_add_to_group(lifeline_thread_tests ${name})
  endif()
  if(NOT system IN_LIST arg_LABELS AND NOT bench IN_LIST arg_LABELS)  # the ones that the address sanitizer build is for
    lifeline_add_to_group(lifeline_inner_tests ${name})
  endif()
  # Joined, since gtest_discover_tests takes lists apart; `ctest -L` looks for parts of a label.
  list(JOIN arg_LABELS "-" labels)
  include(GoogleTest)
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${labels}")
endfunction()

# lifeline_fuzzed(NAME [a.cpp ...]): library NAME, or these sources of it, are what fuzz targets look into: built so that they
# see which ways an input takes. All of the code would take twice as long to build.
function(lifeline_fuzzed name)
  if(NOT LIFELINE_FUZZ)
    return()
  endif()
  if(ARGN)
    set_source_files_properties(${ARGN} PROPERTIES
      COMPILE_OPTIONS -fsanitize=fuzzer-no-link SKIP_UNITY_BUILD_INCLUSION ON)
  else()
    target_compile_options(lifeline_${name} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# lifeline_fuzzer(NAME_fuzz SOURCES a.cpp ... LINK libs...): a libFuzzer program in the preset's bin; nothing without LIFELINE_FUZZ.
function(lifeline_fuzzer name)
  if(NOT LIFELINE_FUZZ)
    return()
  endif()
  lifeline_program(${name} ${ARGN})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  lifeline_add_to_group(lifeline_fuzzers ${name})
endfunction()
