# Sources and tests are listed in the CMakeLists.txt of their room, not globbed. This finds the
# forgotten ones (above all a test that never runs):
#   cmake -DSOURCE_DIR=<root> -DBUILD_DIR=<build> -P check_sources.cmake
cmake_minimum_required(VERSION 3.25)

set(forgotten 0)
macro(report_forgotten file what)
  math(EXPR forgotten "${forgotten} + 1")
  message(NOTICE "${file} ${what}")
endmacro()

file(READ "${BUILD_DIR}/compile_commands.json" named)
# Units of several sources include them by their full names.
file(GLOB_RECURSE units "${BUILD_DIR}/*/unity_*_cxx.cxx")
foreach(unit IN LISTS units)
  file(READ "${unit}" sources)
  string(APPEND named "${sources}")
endforeach()

foreach(room engine io scenarios app tests bench)
  file(GLOB_RECURSE sources RELATIVE "${SOURCE_DIR}" "${SOURCE_DIR}/${room}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "^tests/package/")   # an outside project
  foreach(optional bench bench/simd)   # not built everywhere: then nothing of it is
    string(FIND "${named}" "\"${SOURCE_DIR}/${optional}/" found)
    if(found EQUAL -1)
      list(FILTER sources EXCLUDE REGEX "^${optional}/")
    endif()
  endforeach()
  foreach(source IN LISTS sources)
    string(FIND "${named}" "\"${SOURCE_DIR}/${source}\"" found)
    if(found EQUAL -1)
      report_forgotten("${source}" "is in no target: list it in ${room}/CMakeLists.txt")
    endif()
  endforeach()
endforeach()

# Not all tests in Python are known to ctest in every build. So this looks for their names, each by
# itself, in what makes them known; those of sources (room/test_x.cpp) and of tests (room/test_x) are
# others.
file(GLOB_RECURSE lists
  "${SOURCE_DIR}/tests/CMakeLists.txt" "${SOURCE_DIR}/tests/*.cmake" "${SOURCE_DIR}/bench/CMakeLists.txt")
set(registered "")
foreach(list IN LISTS lists)
  file(READ "${list}" text)
  string(REGEX REPLACE "#[^\n]*" "" text "${text}")
  string(APPEND registered "${text}")
endforeach()
file(GLOB_RECURSE scripts "${SOURCE_DIR}/tests/test_*.py" "${SOURCE_DIR}/bench/test_*.py")
foreach(script IN LISTS scripts)
  cmake_path(GET script STEM name)
  if(name IN_LIST names)
    report_forgotten("${script}" "has the name of another test, which would hide that it never runs")
  endif()
  list(APPEND names ${name})
  if(NOT registered MATCHES "[ (\n]${name}[ .)\n]")
    report_forgotten("${script}" "never runs: make it a test in the CMakeLists.txt of its room")
  endif()
endforeach()

if(forgotten GREATER 0)
  message(FATAL_ERROR "forgotten: ${forgotten}")
endif()
