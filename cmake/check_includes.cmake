# Checks the include rules of the house on the text of the sources: cmake -DSOURCE_DIR=<root> -P
# check_includes.cmake
#
# The build itself enforces which room sees which (RieselTargets.cmake): a header of a room that is
# not linked is not found. It cannot enforce it for headers that lie in /usr/include and so on
# everyone's path (yaml-cpp, fmt, ...), nor for the standard headers that make files and print, nor
# against "../io/settings.hpp". Hence this table, which lists all that is allowed.
#
#   <room>_rooms     other rooms, as regular expressions for "room/header.hpp"
#   <room>_external  headers of libraries and of the system; C++ headers (no dot, no slash) are free
#   <room>_not       exceptions to that

cmake_minimum_required(VERSION 3.25)

set(engine_rooms     "engine/")
set(engine_external  "Eigen/" "omp.h" "Random123/")
set(engine_not       "fstream" "iostream" "filesystem" "cstdio" "print")   # no files, no printing

set(io_rooms         "engine/" "io/")
set(io_external      "hdf5.h" "yaml-cpp/" "udunits2.h" "zlib.h" "nlohmann/" "fmt/"
                     "unistd.h" "fcntl.h" "sys/")

set(scenarios_rooms     "engine/" "io/" "scenarios/")
set(scenarios_external  "fmt/")

set(app_rooms        "engine/" "io/" "scenarios/" "app/")
set(app_external     "CLI/" "fmt/" "omp.h" "unistd.h" "fcntl.h" "poll.h" "spawn.h" "sys/")

set(tests_rooms      "engine/" "io/" "scenarios/" "app/" "tests/")
set(tests_external   ".")

set(bench_rooms      "engine/" "io/" "scenarios/" "app/" "tests/" "bench/")
set(bench_external   ".")

function(matches_any text patterns result)
  set(${result} FALSE PARENT_SCOPE)
  foreach(pattern IN LISTS patterns)
    if(text MATCHES "^${pattern}")
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

set(violations 0)
foreach(room engine io scenarios app tests bench)
  file(GLOB_RECURSE sources RELATIVE "${SOURCE_DIR}"
    "${SOURCE_DIR}/${room}/*.hpp" "${SOURCE_DIR}/${room}/*.cpp" "${SOURCE_DIR}/${room}/*.in")
  list(FILTER sources EXCLUDE REGEX "^tests/package/")   # an outside project
  foreach(source IN LISTS sources)
    file(STRINGS "${SOURCE_DIR}/${source}" lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
      set(allowed FALSE)
      if(line MATCHES "\"([^\"]+)\"")
        set(header "${CMAKE_MATCH_1}")
        if(NOT header MATCHES "\\.\\.")
          matches_any("${header}" "${${room}_rooms}" allowed)
        endif()
      elseif(line MATCHES "<([^>]+)>")
        set(header "${CMAKE_MATCH_1}")
        if(NOT header IN_LIST ${room}_not)
          matches_any("${header}" "[a-z_]+$;${${room}_external}" allowed)
        endif()
      endif()
      if(line MATCHES "include RIESEL_")   # a file of the own room, which the build chooses
        set(allowed TRUE)
      endif()
      if(NOT allowed)
        message(NOTICE "${source}: ${room}/ may not include ${header}")
        math(EXPR violations "${violations} + 1")
      endif()
    endforeach()
  endforeach()
endforeach()

if(violations)
  message(FATAL_ERROR "${violations} include(s) against the rules in cmake/check_includes.cmake")
endif()
