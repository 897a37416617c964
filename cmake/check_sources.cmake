# Sources are listed in the CMakeLists.txt of their room, not globbed. This finds the forgotten ones
# (above all a test that never runs):
#   cmake -DSOURCE_DIR=<root> -DBUILD_DIR=<build> -P check_sources.cmake
cmake_minimum_required(VERSION 3.25)

file(READ "${BUILD_DIR}/compile_commands.json" named)
# Units of several sources include them by their full names.
file(GLOB_RECURSE units "${BUILD_DIR}/*/unity_*_cxx.cxx")
foreach(unit IN LISTS units)
  file(READ "${unit}" sources)
  string(APPEND named "${sources}")
endforeach()

foreach(room engine io scenarios app tests)
  file(GLOB_RECURSE sources "${SOURCE_DIR}/${room}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/tests/package/")   # an outside project
  foreach(source IN LISTS sources)
    string(FIND "${named}" "\"${source}\"" found)
    if(found EQUAL -1)
      message(SEND_ERROR "${source} is in no target: list it in ${room}/CMakeLists.txt")
    endif()
  endforeach()
endforeach()
