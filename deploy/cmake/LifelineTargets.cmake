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
  set(CMAKE_CXX_COMPILER_LAUNCHER "${LIFELINE_CCACHE}")
  if(LIFELINE_PRECOMPILED_HEADERS)  # ccache's manual, "Precompiled headers"
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${LIFELINE_CCACHE}")
    add_compile_options(-fpch-preprocess)
  endif()
endif()
find_program(LIFELINE_MOLD mold)
if(LIFELINE_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# With LIFELINE_PRECOMPILED_HEADERS, what most sources include is parsed once for each preset. It only saves time: a source
# that forgets an include fails in the presets that build without.
set(lifeline_common_headers
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <random> <set>
  <span> <sstream> <string> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)
function(lifeline_precompile target)
  get_target_property(sources ${target} SOURCES)
  if(NOT LIFELINE_PRECOMPILED_HEADERS OR sources MATCHES "\\.c(;|$)")
    return()
  endif()
  cmake_parse_arguments(arg "FOR_TESTS" "" "" ${ARGN})
  set(owner lifeline_precompiled)
  if(arg_FOR_TESTS)
    set(owner lifeline_precompiled_for_tests)
  endif()
  if(NOT TARGET ${owner})
    set(empty "${PROJECT_BINARY_DIR}/generated/${owner}.cpp")
    file(CONFIGURE OUTPUT "${empty}" CONTENT "// Carries the precompiled headers.\n")
    add_library(${owner} STATIC "${empty}")
    target_link_libraries(${owner} PRIVATE Eigen3::Eigen spdlog::spdlog)
    set(headers ${lifeline_common_headers})
    if(arg_FOR_TESTS)
      target_link_libraries(${owner} PRIVATE GTest::gmock)
      list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
    endif()
    target_precompile_headers(${owner} PRIVATE ${headers})
    lifeline_warnings(${owner})  # -Wpedantic changes a macro, and macros must be alike
  endif()
  target_link_libraries(${target} PRIVATE Eigen3::Eigen spdlog::spdlog)  # what the headers were compiled with
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

function(lifeline_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  if(LIFELINE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# lifeline_library(NAME SOURCES a.cpp ... [PUBLIC libs...] [PRIVATE libs...]): target lifeline_NAME, alias lifeline::NAME.
function(lifeline_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(lifeline_${name} STATIC ${arg_SOURCES})
  add_library(lifeline::${name} ALIAS lifeline_${name})
  target_include_directories(lifeline_${name} PUBLIC "${PROJECT_SOURCE_DIR}")
  target_link_libraries(lifeline_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  lifeline_warnings(lifeline_${name})
  lifeline_precompile(lifeline_${name})
endfunction()

# lifeline_program(NAME SOURCES a.cpp ... LINK libs...): program NAME in build/<preset>/bin.
function(lifeline_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_LINK})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
  lifeline_warnings(${name})
  lifeline_precompile(${name})
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
  lifeline_precompile(${name} FOR_TESTS)
  if(threads IN_LIST arg_LABELS)  # the ones that the thread sanitizer build is for
    lifeline_add_to_group(lifeline_thread_tests ${name})
  endif()
  if(NOT system IN_LIST arg_LABELS)  # the ones that the address sanitizer build is for
    lifeline_add_to_group(lifeline_inner_tests ${name})
  endif()
  # Joined, since gtest_discover_tests takes lists apart; `ctest -L` looks for parts of a label.
  list(JOIN arg_LABELS "-" labels)
  include(GoogleTest)
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${labels}")
endfunction()

# lifeline_fuzzer(NAME_fuzz SOURCES a.cpp ... LINK libs...): a libFuzzer program in build/fuzz/bin; nothing in other presets.
function(lifeline_fuzzer name)
  if(NOT LIFELINE_FUZZ)
    return()
  endif()
  lifeline_program(${name} ${ARGN})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  lifeline_add_to_group(lifeline_fuzzers ${name})
endfunction()
