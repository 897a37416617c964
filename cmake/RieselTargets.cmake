# How a room of the house becomes a target: warnings, arithmetic, sanitizers, and what a room may
# include.
#
#   riesel_library(engine SOURCES a.cpp ... [PRIVATE_HEADERS b.hpp ...] [PUBLIC_HEADERS c.hpp ...]
#                  [PUBLIC targets...] [PRIVATE targets...])
#   riesel_program(riesel ROOM app SOURCES main.cpp ... LINK targets...)
#
# What a room may include (the table in docs/architecture.md) is enforced by the compiler. Includes
# are written from the root of the project, `#include "engine/state.hpp"`, but the root is on
# nobody's include path. Each room has a directory of its own in the build tree that holds one
# symbolic link, include-rooms/engine/engine -> <source>/engine, and that directory is what a target
# exports. So a room sees the rooms it links and no others. cmake/check_includes.cmake covers what
# the compiler cannot see.

option(RIESEL_NATIVE "Compile for this machine only: the program may not run on others" OFF)
option(RIESEL_UNITY "Compile several sources at a time: the whole is built sooner, a change later" OFF)
set(RIESEL_TUNE icelake-server CACHE STRING
  "GCC on x86-64: the processor (-mtune) for which instructions are chosen; it runs on all")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release or RelWithDebInfo" FORCE)
endif()

if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  message(FATAL_ERROR "riesel needs GCC or Clang: its exact arithmetic rests on their options")
endif()

# Same input, same bits. GCC's default contracts a*b+c into a fused multiply-add wherever the
# instruction set has one, so that a machine with FMA, a clone of a kernel for a newer instruction
# set, or an inlined copy of a function would round differently. Off everywhere, in users of the
# headers too (PUBLIC below). For the same reason: never -ffast-math, -Ofast or any part of them
# that may change a value.
set(riesel_arithmetic -ffp-contract=off)

# Up to version 18 Clang leaves this part of C++14 out by default, and the engine's headers use it.
set(riesel_language $<$<CXX_COMPILER_ID:Clang>:-fsized-deallocation>)

# These two change no value. They let the compiler vectorise sqrt and branches: nothing here reads
# errno after a math function, or the floating-point exception flags.
set(riesel_arithmetic_private -fno-math-errno -fno-trapping-math)

# Which machine the instructions are for; no choice changes a value. GCC's own takes no gathers and
# no vectors of 512 bits for the kernels that are compiled for machines that have them.
if(RIESEL_NATIVE)
  set(riesel_machine -march=native)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(riesel_machine -mtune=${RIESEL_TUNE} -mprefer-vector-width=512)
endif()

# The presets for users optimise across sources when they link: 2 to 5 % faster by windows. The
# libraries keep their usual code beside, for linkers that cannot read the other.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(CMAKE_CXX_COMPILE_OPTIONS_IPO -flto=auto -ffat-lto-objects)
endif()

# GCC 12 sees overlapping copies (its bug 105651), and endless ones, inside std::string where there
# are none.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  set(riesel_false_warnings -Wno-restrict)
  add_link_options($<$<BOOL:${CMAKE_INTERPROCEDURAL_OPTIMIZATION}>:-Wno-stringop-overflow>)
endif()

add_library(riesel_warnings INTERFACE)
target_compile_options(riesel_warnings INTERFACE
  -Wall -Wextra -Wpedantic
  -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion
  -Wold-style-cast -Wcast-qual -Wcast-align
  -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi
  -Wformat=2 -Wundef -Wimplicit-fallthrough
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wduplicated-branches -Wlogical-op -Wsuggest-override>
  ${riesel_false_warnings}
  $<$<BOOL:${RIESEL_WERROR}>:-Werror>)

# Sanitizers must agree over the whole program, hence not per target.
if(RIESEL_SANITIZE)
  add_compile_options(
    -fsanitize=${RIESEL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${RIESEL_SANITIZE})
endif()

# The include directory of a room, and the link in it.
function(riesel_room_include room result)
  set(dir "${PROJECT_BINARY_DIR}/include-rooms/${room}")
  file(MAKE_DIRECTORY "${dir}")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${room}" "${dir}/${room}" SYMBOLIC)
  set(${result} "${dir}" PARENT_SCOPE)
endfunction()

# What every target of the house shares.
function(riesel_house_rules target)
  target_compile_options(${target} PRIVATE ${riesel_arithmetic_private} ${riesel_machine})
  # The kernels of the engine take most of its time, whether alone or not. clang-tidy reads it in
  # units as well: the preset lint.
  if(RIESEL_UNITY AND NOT target STREQUAL riesel_engine)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
  endif()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD_CODE_BEFORE_INCLUDE "// NOLINTNEXTLINE(bugprone-suspicious-include)")
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:riesel_warnings>)
endfunction()

# PRIVATE_HEADERS need libraries that are PRIVATE, and are not installed; if there are
# PUBLIC_HEADERS, no others are.
function(riesel_library room)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;PRIVATE_HEADERS;PUBLIC_HEADERS;PUBLIC;PRIVATE")
  set(target riesel_${room})
  riesel_room_include(${room} include_dir)
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(riesel::${room} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${room})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${include_dir}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/riesel>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PUBLIC ${riesel_arithmetic} ${riesel_language})
  riesel_house_rules(${target})
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY RIESEL_LIBRARIES ${room})
  set_property(GLOBAL PROPERTY RIESEL_PRIVATE_HEADERS_${room} ${arg_PRIVATE_HEADERS})
  set_property(GLOBAL PROPERTY RIESEL_PUBLIC_HEADERS_${room} ${arg_PUBLIC_HEADERS})
endfunction()

function(riesel_program target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "ROOM" "SOURCES;LINK")
  riesel_room_include(${arg_ROOM} include_dir)
  add_executable(${target} ${arg_SOURCES})
  target_include_directories(${target} PRIVATE ${include_dir})
  target_compile_options(${target} PRIVATE ${riesel_arithmetic} ${riesel_language})
  riesel_house_rules(${target})
  target_link_libraries(${target} PRIVATE ${arg_LINK})
endfunction()
