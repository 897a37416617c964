# Every package that riesel needs, in one place: the build includes this file, and so does the
# installed rieselConfig.cmake (which needs less: RIESEL_DEPENDENCIES_FOR_PACKAGE is set there). All
# missing packages are named in one message, each with Debian's name for it.

set(riesel_missing "")

# riesel_require(<package> <Debian package> [arguments of find_package...])
macro(riesel_require package debian)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    list(APPEND riesel_missing "${package} (Debian: ${debian})")
  endif()
endmacro()

# What the libraries link: a program that uses the installed riesel needs these too.
riesel_require(Threads libc6-dev)
riesel_require(OpenMP g++ COMPONENTS CXX)
riesel_require(HDF5 libhdf5-dev 1.10 COMPONENTS C)
riesel_require(yaml-cpp libyaml-cpp-dev)
riesel_require(fmt libfmt-dev 9)
riesel_require(UDUNITS2 libudunits2-dev)
riesel_require(ZLIB zlib1g-dev)

# Headers and programs that only the build of riesel itself needs.
if(NOT RIESEL_DEPENDENCIES_FOR_PACKAGE)
  riesel_require(Eigen3 libeigen3-dev 3.4)
  riesel_require(nlohmann_json nlohmann-json3-dev 3.10)
  riesel_require(CLI11 libcli11-dev 2.1)
  riesel_require(Random123 librandom123-dev)
  if(RIESEL_TESTS)
    find_package(Catch2 3 QUIET)
    if(NOT Catch2_FOUND)
      riesel_require(Catch2 catch2 2.13)
    endif()
  endif()
endif()

# yaml-cpp has its namespaced target since 0.8 only.
if(TARGET yaml-cpp AND NOT TARGET yaml-cpp::yaml-cpp)
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()

if(riesel_missing)
  list(JOIN riesel_missing "\n  " riesel_missing)
  set(riesel_missing "riesel needs packages that were not found:\n  ${riesel_missing}\n")
  if(NOT RIESEL_DEPENDENCIES_FOR_PACKAGE)
    message(FATAL_ERROR "${riesel_missing}On Debian, `./setup.sh packages` installs them.")
  endif()
endif()
