# Installation: the program with its scenarios and manual, the libraries with their headers and a CMake
# package (component dev), and the Python package (component python). RieselPackages.cmake makes
# a Debian package of each component.
#
# Headers go to include/riesel/<room>/, and include/riesel is the include directory of the exported
# targets: outside as inside, a header is `#include "engine/state.hpp"`.

include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME riesel)

set(riesel_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/riesel")
set(riesel_scenarios_dir "${CMAKE_INSTALL_DATADIR}/riesel/scenarios")

get_property(rooms GLOBAL PROPERTY RIESEL_LIBRARIES)
list(TRANSFORM rooms PREPEND riesel_ OUTPUT_VARIABLE libraries)

install(TARGETS riesel RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(TARGETS ${libraries} EXPORT riesel
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
foreach(room IN LISTS rooms)
  get_property(headers GLOBAL PROPERTY RIESEL_PUBLIC_HEADERS_${room})
  if(NOT headers)
    file(GLOB headers RELATIVE "${PROJECT_SOURCE_DIR}/${room}" "${PROJECT_SOURCE_DIR}/${room}/*.hpp")
    get_property(private_headers GLOBAL PROPERTY RIESEL_PRIVATE_HEADERS_${room})
    list(REMOVE_ITEM headers ${private_headers})
  endif()
  list(TRANSFORM headers PREPEND "${PROJECT_SOURCE_DIR}/${room}/")
  install(FILES ${headers}
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/riesel/${room}" COMPONENT dev)
endforeach()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenarios/" DESTINATION "${riesel_scenarios_dir}"
  FILES_MATCHING PATTERN "*.yaml")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")

install(EXPORT riesel NAMESPACE riesel:: FILE rieselExports.cmake
  DESTINATION "${riesel_package_dir}" COMPONENT dev)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/rieselConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/rieselConfig.cmake"
  INSTALL_DESTINATION "${riesel_package_dir}"
  PATH_VARS riesel_scenarios_dir)
# Before 1.0 a new minor version may break.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rieselConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/rieselConfig.cmake"
  "${PROJECT_BINARY_DIR}/rieselConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/RieselDependencies.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindUDUNITS2.cmake"
  DESTINATION "${riesel_package_dir}" COMPONENT dev)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libriesel-dev" COMPONENT dev)

# Where Debian's Python looks for packages, below /usr; the metadata tell Python's tools the version.
set(RIESEL_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Where the Python package goes")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/python/riesel"
  DESTINATION "${RIESEL_PYTHON_DIR}" COMPONENT python
  FILES_MATCHING PATTERN "*.py" PATTERN py.typed)
configure_file("${PROJECT_SOURCE_DIR}/python/METADATA.in"
  "${PROJECT_BINARY_DIR}/python/METADATA" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/python/METADATA"
  DESTINATION "${RIESEL_PYTHON_DIR}/riesel-${PROJECT_VERSION}.dist-info" COMPONENT python)

# Each package has a copy, by the name that Debian wants.
foreach(package IN ITEMS riesel:riesel libriesel-dev:dev python3-riesel:python)
  string(REPLACE ":" ";" package "${package}")
  list(POP_FRONT package name)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name}"
    RENAME copyright COMPONENT ${package})
endforeach()

if(PROJECT_IS_TOP_LEVEL)
  include(RieselPackages)
endif()
