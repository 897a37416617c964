# Before cpack makes packages: without dpkg-shlibdeps it would leave out, with no word, what they depend on.
foreach(tool IN ITEMS dpkg-shlibdeps file)
  find_program(${tool}_program ${tool})
  if(NOT ${tool}_program)
    message(FATAL_ERROR "Debian packages need the program ${tool}: apt install dpkg-dev file")
  endif()
endforeach()
